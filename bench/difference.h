// SPDX-License-Identifier: Apache-2.0
// Results compared bit by bit.
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

namespace sobb::bench {

inline constexpr size_t kEqual = static_cast<size_t>(-1);

/// The first element whose bits differ, or kEqual. NaN equals NaN, 0 is not -0. Of equal lengths.
template <typename T>
size_t first_difference(const std::vector<T>& a, const std::vector<T>& b) {
  static_assert(std::is_trivially_copyable_v<T>);
  for (size_t i = 0; i < a.size(); ++i) {
    if (std::memcmp(&a[i], &b[i], sizeof(T)) != 0) return i;
  }
  return kEqual;
}

}  // namespace sobb::bench
