// SPDX-License-Identifier: Apache-2.0
// What leaves hold: triangles, or where spatial splits cut a triangle, parts of it.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "builder/boxes/box.h"

namespace sobb {

// The most references in a leaf.
inline constexpr uint32_t kMaxLeafReferences = 8;

// All of space: the cut box of a reference to a whole triangle, since nothing is cut off it.
inline constexpr Box kUncut = {
    {-std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
     -std::numeric_limits<float>::infinity()},
    {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
     std::numeric_limits<float>::infinity()}};

// References of a hierarchy's leaves, in the order of the leaves. Within a leaf triangles rise by
// index.
struct References {
  std::span<const uint32_t> primitives;  // the triangles
  // The box that each triangle is cut to, kUncut for a whole one. Empty where all are whole.
  std::span<const Box> cuts;

  size_t size() const { return primitives.size(); }
  bool is_cut(size_t i) const {
    return !cuts.empty() && cuts[i].lower[0] > kUncut.lower[0];  // finite boxes only
  }

  References part(uint64_t first, uint64_t count) const {
    return {primitives.subspan(first, count), cuts.empty() ? cuts : cuts.subspan(first, count)};
  }
};

}  // namespace sobb
