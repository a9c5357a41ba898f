// SPDX-License-Identifier: Apache-2.0
// A caller's allocator that keeps the books: what is held, at which size and alignment.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <mutex>
#include <utility>

#include "sobb/sobb.h"

namespace sobb::test {

class CountingAllocator {
 public:
  // Fails at the n-th allocation; never by default.
  explicit CountingAllocator(uint64_t fail_at = UINT64_MAX) : fail_at_(fail_at) {}
  ~CountingAllocator() { EXPECT_TRUE(held_.empty()) << held_.size() << " blocks are left"; }
  CountingAllocator(const CountingAllocator&) = delete;
  CountingAllocator& operator=(const CountingAllocator&) = delete;

  // The next `count` allocations fail.
  void refuse_next(uint64_t count) { refusals_ = count; }

  sobb_allocator callback() { return {this, allocate, deallocate}; }
  uint64_t calls() const { return calls_; }
  size_t blocks() const { return held_.size(); }

 private:
  static void* allocate(void* user, size_t size, size_t alignment) {
    auto* self = static_cast<CountingAllocator*>(user);
    const std::scoped_lock lock(self->mutex_);
    if (self->calls_++ == self->fail_at_) return nullptr;
    if (self->refusals_ != 0) {
      --self->refusals_;
      return nullptr;
    }
    void* block = nullptr;
    if (posix_memalign(&block, std::max(alignment, sizeof(void*)), size) != 0) return nullptr;
    self->held_[block] = {size, alignment};
    return block;
  }

  static void deallocate(void* user, void* block, size_t size, size_t alignment) {
    auto* self = static_cast<CountingAllocator*>(user);
    const std::scoped_lock lock(self->mutex_);
    const auto found = self->held_.find(block);
    if (found == self->held_.end()) {
      ADD_FAILURE() << "a block comes back that was not given";
      return;
    }
    EXPECT_EQ(found->second, std::pair(size, alignment));
    self->held_.erase(found);
    std::free(block);
  }

  std::mutex mutex_;
  std::map<void*, std::pair<size_t, size_t>> held_;
  uint64_t calls_ = 0;
  uint64_t fail_at_;
  uint64_t refusals_ = 0;
};

}  // namespace sobb::test
