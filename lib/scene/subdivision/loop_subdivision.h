// SPDX-License-Identifier: Apache-2.0
// Refined scenes, SOURCE^TIMES: the same shape in 4, 16 or 64 times the triangles, so that a study
// can plot cost against size.
//
// The room subdivision/ refines a finished scene: manifold_corners.h finds the surface that its
// triangles make, and OpenMesh subdivides that.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/progress.h"
#include "scene/model/scene.h"

namespace sobb {

// Parses what follows the '^' of a source. Returns the number of subdivisions: 1, 2 or 3 for 4, 16
// or 64. Error SCENE_SYNTAX, naming `source`, where that is none of them.
unsigned parse_subdivisions(const std::string& source, std::string_view text);

// Subdivides a finished scene that many times by C. Loop's masks (*Smooth Subdivision Surfaces
// Based on Triangles*, 1987) and measures it again; views stay as they are. The triangles that come
// from one lie together, in the order of those they come from. Where ManifoldCorners says that the
// surface ends, it is smoothed along its end as a curve. Time grows with the square of the most
// triangles about one vertex. Errors: CANCELLED; naming `source`, MEMORY_LIMIT, and TOO_LARGE for
// too many triangles.
void subdivide_scene(const std::string& source, unsigned subdivisions, uint64_t memory_limit,
                     Scene& scene, Progress* progress);

}  // namespace sobb
