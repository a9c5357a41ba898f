// SPDX-License-Identifier: Apache-2.0
// What a scene says of its triangles.
#pragma once

#include "scene/scene.h"

namespace sobb {

// Counts the degenerate triangles of a scene and finds its bounds.
void measure(Scene& scene);

}  // namespace sobb
