// SPDX-License-Identifier: Apache-2.0
// The k-DOP of a set of triangles: the slab along every direction of the table.
#pragma once

#include <algorithm>
#include <cstdint>

#include "bounds/basis.h"

namespace sobb {

// The slabs lower <= n . (p - c) <= upper. They are conservative: wider than the exact ones by the
// rounding of the dot product. Entries beyond the table's count are zero.
struct alignas(64) Kdop {
  float lower[kMaxDirections];
  float upper[kMaxDirections];

  void merge(const Kdop& other) {
    for (uint32_t k = 0; k < kMaxDirections; ++k) {
      lower[k] = std::min(lower[k], other.lower[k]);
      upper[k] = std::max(upper[k], other.upper[k]);
    }
  }
};

}  // namespace sobb
