// SPDX-License-Identifier: Apache-2.0
// The costs that the surface area heuristic of the topology counts.
#pragma once

namespace sobb {

// Costs of a binary step and of a block of four triangles. A wide node takes about three binary
// steps at once. (When the step's cost goes from 0.25 to 1, a ray's visits shift between nodes and
// blocks, its time stays, and files become smaller.)
inline constexpr float kBinaryStepCost = 0.75F;
inline constexpr float kLeafBlockCost = 1.0F;

}  // namespace sobb
