// SPDX-License-Identifier: Apache-2.0
// SlabChildren holds the planes of the N slabs of every child of a node, as a structure of arrays.
#pragma once

#include <cstdint>

namespace sobb::study {

template <int N, int W>
struct SlabChildren {
  float slab[N][2][W];

  void set_slabs(uint32_t i, const float (&planes)[N][2]) {
    for (int k = 0; k < N; ++k) {
      for (int side = 0; side < 2; ++side) slab[k][side][i] = planes[k][side];
    }
  }
  void get_slabs(uint32_t i, float (&planes)[N][2]) const {
    for (int k = 0; k < N; ++k) {
      for (int side = 0; side < 2; ++side) planes[k][side] = slab[k][side][i];
    }
  }
};

}  // namespace sobb::study
