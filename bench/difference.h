// SPDX-License-Identifier: Apache-2.0
// Results compared bit by bit.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <vector>

namespace sobb::bench {

inline constexpr size_t kEqual = static_cast<size_t>(-1);

/// Its bytes, so that floats compare by bits.
template <typename T>
auto bits(const T& value) {
  return std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
}

/// The first element whose bits differ, or kEqual. Of equal lengths.
template <typename T>
size_t first_difference(const std::vector<T>& a, const std::vector<T>& b) {
  for (size_t i = 0; i < a.size(); ++i) {
    if (bits(a[i]) != bits(b[i])) return i;
  }
  return kEqual;
}

}  // namespace sobb::bench
