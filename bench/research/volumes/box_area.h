// SPDX-License-Identifier: Apache-2.0
// The surface area of a scene's box, which sums of areas are given relative to.
#pragma once

#include "builder/boxes/box.h"
#include "builder/mesh.h"

namespace sobb::study {

inline double box_area(const MeshSummary& scene) {
  const Box box = {{scene.lower.x, scene.lower.y, scene.lower.z},
                   {scene.upper.x, scene.upper.y, scene.upper.z}};
  return 2 * box.half_area();
}

}  // namespace sobb::study
