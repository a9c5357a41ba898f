// SPDX-License-Identifier: Apache-2.0
// A direction table fitted to a scene: the well-spread set turned into the scene's own frame, with
// the scene's dominant directions among it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bounds/basis.h"
#include "bounds/direction_histogram.h"

namespace sobb {

// Three perpendicular unit vectors out of the heaviest peaks: the first of the normals; the first
// perpendicular to it, of the normals or else of the edges; their cross product. Ordered and signed
// as near to the axes as can be; the axes themselves where that is within rounding, or where no
// normal stands out.
struct SceneFrame {
  Vector axis[3];
};
SceneFrame scene_frame(std::span<const DirectionPeak> normals,
                       std::span<const DirectionPeak> edges);

// k/2 directions: the frame, then the default set turned into it, in which the normals that the
// frame lacks replace what is nearest to them.
std::vector<Direction> fit_directions(uint32_t k, const SceneFrame& frame,
                                      std::span<const DirectionPeak> normals);

}  // namespace sobb
