// SPDX-License-Identifier: Apache-2.0
// Compares arrays of floats by their bits, so that the signs of zeros count.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace sobb::test {

template <size_t kCount>
bool same_bits(const float (&a)[kCount], const float (&b)[kCount]) {
  return std::equal(a, a + kCount, b, [](float x, float y) {
    return std::bit_cast<uint32_t>(x) == std::bit_cast<uint32_t>(y);
  });
}

}  // namespace sobb::test
