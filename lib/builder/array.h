// SPDX-License-Identifier: Apache-2.0
// An array of plain values without any at first: the threads that fill it touch its pages first.
#pragma once

#include <memory_resource>
#include <span>
#include <type_traits>
#include <utility>

namespace sobb {

template <class T>
class Array {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  Array() = default;
  Array(uint64_t size, std::pmr::memory_resource& memory)
      : memory_(&memory),
        data_(static_cast<T*>(memory.allocate(size * sizeof(T), alignof(T)))),
        size_(size) {}
  ~Array() {
    if (data_ != nullptr) memory_->deallocate(data_, size_ * sizeof(T), alignof(T));
  }
  Array(Array&& other) noexcept { swap(other); }
  Array& operator=(Array&& other) noexcept {
    Array(std::move(other)).swap(*this);
    return *this;
  }

  T* data() { return data_; }
  const T* data() const { return data_; }
  uint64_t size() const { return size_; }
  T& operator[](uint64_t i) { return data_[i]; }
  const T& operator[](uint64_t i) const { return data_[i]; }
  operator std::span<const T>() const { return {data_, size_}; }

 private:
  void swap(Array& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }

  std::pmr::memory_resource* memory_ = nullptr;
  T* data_ = nullptr;
  uint64_t size_ = 0;
};

}  // namespace sobb
