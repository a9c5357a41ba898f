// SPDX-License-Identifier: Apache-2.0
// What a scene says of its triangles: how many are degenerate, and the box about them.
#pragma once

#include "base/progress.h"
#include "scene/model/scene.h"

namespace sobb {

// Counts the degenerate triangles of a scene and finds its bounds. Progress, if any, runs from
// `progress_begin` to 1.
void measure(Scene& scene, Progress* progress, double progress_begin);

// These follow from the bounds that measure() found.
Vec3 box_centre(const Scene& scene);
double half_diagonal(const Scene& scene);

}  // namespace sobb
