// SPDX-License-Identifier: Apache-2.0
// What the surface area heuristic weighs areas with, as the library does: a binary step and a block
// of triangles as its topology builder has them, a wide node's test as its choice of bases has it.
#pragma once

#include "format/layout.h"

namespace sobb::study {

inline constexpr float kStepCost = 0.5F;
inline constexpr float kWideNodeCost = 1.0F;
inline constexpr float kBlockCost = 1.0F;

inline float triangles_cost(uint32_t count) {
  return kBlockCost * static_cast<float>(blocks_of(count));
}

}  // namespace sobb::study
