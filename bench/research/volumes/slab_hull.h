// SPDX-License-Identifier: Apache-2.0
// SlabHull is the k-DOP that volumes are taken from, for tables of up to N directions.
#pragma once

#include <algorithm>
#include <cstdint>

#include "volumes/tables.h"

namespace sobb::study {

// The slabs lower <= n . (p - c) <= upper are conservative, as those of Kdop are.
template <uint32_t N>
struct alignas(64) SlabHull {
  float lower[N];
  float upper[N];

  void fit(const Tables& tables, const RelativePoint* points, uint64_t count) {
    Kdop kdop;
    uint32_t first = 0;
    for (const DirectionTable& chunk : tables.chunks) {
      tables.kernels.fit(chunk, points, count, kdop);
      constexpr uint32_t kLength = std::min(N, kMaxDirections);
      std::copy(kdop.lower, kdop.lower + kLength, lower + first);
      std::copy(kdop.upper, kdop.upper + kLength, upper + first);
      first += kLength;
    }
  }

  void merge(const SlabHull& other) {
    for (uint32_t k = 0; k < N; ++k) {
      lower[k] = std::min(lower[k], other.lower[k]);
      upper[k] = std::max(upper[k], other.upper[k]);
    }
  }

  // Chooses the triple of least area by the strategy, or the axes where they have less.
  TripleChoice choose(const Tables& tables) const {
    alignas(64) float width[N];
    for (uint32_t k = 0; k < N; ++k) width[k] = (upper[k] - lower[k]) * tables.scale;
    const TripleChoice choice = tables.kernels.choose_one(tables.bases, width, tables.strategy);
    return or_frame(tables.bases, width, choice);
  }
};

}  // namespace sobb::study
