// SPDX-License-Identifier: Apache-2.0
// A ray in a list, in 32 bits that order by distance:
//   bits 16-31  how far away it meets what the list is of: the float's upper half, so rounded down
//               (it is not negative), and culling by it stays conservative
//   bits 0-15   the ray's index in its batch
#pragma once

#include <bit>
#include <cstdint>

namespace sobb {

using RayEntry = uint32_t;

inline constexpr RayEntry kEntryDistance = 0xFFFF0000;

constexpr uint32_t entry_ray(RayEntry entry) { return entry & ~kEntryDistance; }
constexpr float entry_distance(RayEntry entry) {
  return std::bit_cast<float>(entry & kEntryDistance);
}

}  // namespace sobb
