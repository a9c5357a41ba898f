// SPDX-License-Identifier: Apache-2.0
// Memory is what one call, and the hierarchy that it returns, may take: it keeps the limit, the
// caller's allocator and the peak.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory_resource>

#include "sobb/sobb.h"

namespace sobb {

// A memory resource for std::pmr containers. Thread-safe. Throws std::bad_alloc where the allocator
// fails and Error(SOBB_ERROR_MEMORY_LIMIT) where the limit would be exceeded.
class Memory final : public std::pmr::memory_resource {
 public:
  // `allocator` may be null for the library's own; it is copied. A `limit` of 0 is none.
  explicit Memory(const sobb_allocator* allocator = nullptr, uint64_t limit = 0);

  uint64_t held() const { return held_.load(std::memory_order_relaxed); }
  uint64_t peak() const { return peak_.load(std::memory_order_relaxed); }
  uint64_t limit() const { return limit_; }

  // Lifts the limit at the end of the call that was given it: what the hierarchy keeps is free of
  // it.
  void lift_limit() { limit_ = 0; }

 private:
  void* do_allocate(size_t size, size_t alignment) override;
  void do_deallocate(void* pointer, size_t size, size_t alignment) override;
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
  bool add(uint64_t bytes);  // false where the limit would be exceeded; then nothing is added
  void raise_peak(uint64_t held);

  sobb_allocator allocator_;
  uint64_t limit_;
  std::atomic<uint64_t> held_{0};
  std::atomic<uint64_t> peak_{0};
};

}  // namespace sobb
