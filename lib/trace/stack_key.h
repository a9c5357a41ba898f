// SPDX-License-Identifier: Apache-2.0
// A traversal's stack entry in 64 bits, ordered by distance:
//   bits 39-63  the near distance's exponent and upper 17 mantissa bits (it is not negative)
//   bit 38      leaf;  bits 32-37  a leaf's triangles
//   bits 0-31   index of a node or of a leaf's first block
// The distance is rounded down, so that culling by it stays conservative.
#pragma once

#include <bit>
#include <cstdint>

#include "format/layout.h"

namespace sobb {

using StackKey = uint64_t;

inline constexpr uint32_t kKeyMetaMask = 0x7F;
inline constexpr StackKey kRootKey = 0;

constexpr bool key_is_leaf(StackKey key) { return (key >> 38 & 1) != 0; }
constexpr uint32_t key_triangles(StackKey key) { return key >> 32 & kTriangleMask; }
constexpr uint32_t key_index(StackKey key) { return static_cast<uint32_t>(key); }

// Of a child at a distance, by its words in the node.
inline StackKey make_key(float distance, uint32_t meta, uint32_t reference) {
  const uint32_t high = (std::bit_cast<uint32_t>(distance) << 1 & ~kKeyMetaMask) |
                        (meta >> 9 & kLeafBit >> 9) | (meta & kTriangleMask);
  return static_cast<StackKey>(high) << 32 | reference;
}

// The largest key whose node a ray with this limit must still visit.
inline StackKey last_key(float limit) {
  const uint32_t distance = std::bit_cast<uint32_t>(limit) << 1 | kKeyMetaMask;
  return static_cast<StackKey>(distance) << 32 | 0xFFFFFFFF;
}

}  // namespace sobb
