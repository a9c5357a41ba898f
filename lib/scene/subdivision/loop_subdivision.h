// SPDX-License-Identifier: Apache-2.0
// Refined scenes, SOURCE^TIMES: the same shape in 4, 16 or 64 times the triangles, so that cost
// against size is a curve.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/progress.h"
#include "scene/model/scene.h"

namespace sobb {

// What follows the '^' of a scene's name, as a number of subdivisions: 1, 2 or 3 for 4, 16 or 64.
// Error SCENE_SYNTAX, naming `source`, where it is none of them.
unsigned parse_subdivisions(const std::string& source, std::string_view text);

// Subdivides a finished scene so often by C. Loop's masks (*Smooth Subdivision Surfaces Based on
// Triangles*, 1987), by OpenMesh, and measures it again; views stay as they are. The triangles that
// come from one lie together, in the order of those they come from. The surface ends, and is
// smoothed along its end as a curve, where ManifoldCorners says so. Time grows with the square of
// the most triangles about one vertex. Errors: CANCELLED; naming `source`, MEMORY_LIMIT, TOO_LARGE
// where there would be too many triangles.
void subdivide_scene(const std::string& source, unsigned subdivisions, uint64_t memory_limit,
                     Scene& scene, Progress* progress);

}  // namespace sobb
