// SPDX-License-Identifier: Apache-2.0
// first_difference() compares results bit by bit.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <vector>

namespace sobb::bench {

inline constexpr size_t kEqual = static_cast<size_t>(-1);

/// The value's bytes, so that floats compare by bits.
template <typename T>
auto bits(const T& value) {
  return std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
}

/// The first element whose bits differ, or kEqual. Both have the same length.
template <typename T>
size_t first_difference(const std::vector<T>& a, const std::vector<T>& b) {
  for (size_t i = 0; i < a.size(); ++i) {
    if (bits(a[i]) != bits(b[i])) return i;
  }
  return kEqual;
}

}  // namespace sobb::bench
