// SPDX-License-Identifier: Apache-2.0
// HeapWatch measures the most that the heap held during a call, where AddressSanitizer counts it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sobb::fuzz {

// Only one lives at a time. It counts what its thread allocates while it lives.
class HeapWatch {
 public:
  HeapWatch();
  ~HeapWatch();
  HeapWatch(const HeapWatch&) = delete;
  HeapWatch& operator=(const HeapWatch&) = delete;

  // Bytes beyond those held at the start; 0 in builds without AddressSanitizer.
  int64_t peak() const;
};

}  // namespace sobb::fuzz
