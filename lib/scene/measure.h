// SPDX-License-Identifier: Apache-2.0
// What a scene says of its triangles.
#pragma once

#include "base/progress.h"
#include "scene/scene.h"

namespace sobb {

// Counts the degenerate triangles of a scene and finds its bounds. Progress, if any, runs from
// `progress_begin` to 1.
void measure(Scene& scene, Progress* progress, double progress_begin);

}  // namespace sobb
