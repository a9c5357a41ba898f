// SPDX-License-Identifier: Apache-2.0
// TraceOutput holds what a pass over a ray set found.
#pragma once

#include <cstdint>
#include <vector>

#include "ray_sets.h"

namespace sobb::bench {

struct TraceOutput {
  std::vector<sobb_hit> hits;     // of closest-hit rays
  std::vector<uint8_t> occluded;  // of any-hit rays

  /// Makes room, before the clock starts.
  void resize(const RaySet& set) {
    hits.resize(set.any_hit() ? 0 : set.rays.size());
    occluded.resize(set.any_hit() ? set.rays.size() : 0);
  }
};

}  // namespace sobb::bench
