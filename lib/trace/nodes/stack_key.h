// SPDX-License-Identifier: Apache-2.0
// A traversal's stack entry in 64 bits, ordered by distance:
//   bits 38-63  the near distance without its 6 lowest bits (it is not negative)
//   bits 32-37  a leaf's triangle count; 0 for a node
//   bits 0-31   index of a node or of a leaf's first block
// The distance is rounded down, so that culling by it stays conservative.
#pragma once

#include <bit>
#include <cstdint>

#include "format/layout.h"

namespace sobb {

using StackKey = uint64_t;

inline constexpr uint32_t kKeyMetaMask = 0x3F;
inline constexpr StackKey kRootKey = 0;
// Nothing is left to visit. It equals no leaf's key, since 63 triangles need more blocks than the
// last, and it is not beyond any limit.
inline constexpr StackKey kNoKey = StackKey{kTriangleMask} << 32 | 0xFFFFFFFF;

constexpr uint32_t key_triangles(StackKey key) { return key >> 32 & kTriangleMask; }
constexpr bool key_is_leaf(StackKey key) { return key_triangles(key) != 0; }
constexpr uint32_t key_index(StackKey key) { return static_cast<uint32_t>(key); }

// Packs a child's distance, meta word and reference into a key.
inline StackKey make_key(float distance, uint32_t meta, uint32_t reference) {
  const uint32_t high =
      (std::bit_cast<uint32_t>(distance) & ~kKeyMetaMask) | (meta & kTriangleMask);
  return static_cast<StackKey>(high) << 32 | reference;
}

// The largest key whose node a ray with this limit must still visit.
inline StackKey last_key(float limit) {
  const uint32_t distance = std::bit_cast<uint32_t>(limit) | kKeyMetaMask;
  return static_cast<StackKey>(distance) << 32 | 0xFFFFFFFF;
}

}  // namespace sobb
