// SPDX-License-Identifier: Apache-2.0
// The costs by which the study's surface area heuristic weighs areas, in tests of a wide node.
#pragma once

#include "builder/sah/sah_costs.h"
#include "format/layout.h"

namespace sobb::study {

// The library counts a binary step as 0.75 (kBinaryStepCost). The study keeps the 0.5 that
// docs/data/study-topologies.json was measured with.
inline constexpr float kStepCost = 0.5F;
inline constexpr float kWideNodeCost = 1.0F;

inline float triangles_cost(uint32_t count) {
  return kLeafBlockCost * static_cast<float>(blocks_of(count));
}

}  // namespace sobb::study
