// SPDX-License-Identifier: Apache-2.0
// Directions, and the three of them that a skewed box is made of.
//
// `lib/bounds` bounds triangles, and knows neither meshes nor hierarchies: directions and bases
// (basis, directions/), the k-DOP (kdop.h), areas (area, basis_table), and the vector code that
// fits k-DOPs and searches bases (bounds_kernels.h and the -inl.h files). It knows `lib/base`.
#pragma once

#include <cstdint>

namespace sobb {

// A unit normal, within rounding.
struct Direction {
  float x, y, z;
};

inline constexpr uint32_t kMaxDirections = 32;  // five bits per index

// A basis is three indices of directions in 16 bits, the j-th in bits 5j to 5j+4.
constexpr uint32_t basis_direction(uint32_t basis, int j) { return basis >> (5 * j) & 31; }
constexpr uint16_t make_basis(uint32_t a, uint32_t b, uint32_t c) {
  return static_cast<uint16_t>(a | b << 5 | c << 10);
}
// The basis of the table's frame, its first three directions; in a spread table these are the axes.
inline constexpr uint16_t kAxesBasis = make_basis(0, 1, 2);

}  // namespace sobb
