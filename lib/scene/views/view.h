// SPDX-License-Identifier: Apache-2.0
// Views of a scene: which are possible, those of a file's cameras, and the default one.
//
// The room views/ makes the views that load_scene() chooses from; views_file.h reads them from
// JSON.
#pragma once

#include <vector>

#include "scene/model/scene.h"

namespace sobb {

// Returns whether a picture can be made: all numbers finite, the eye off its target, up not along
// the direction, an angle between 0 and 180 degrees.
bool is_possible(const sobb_view& view);

// The cameras as views whose targets are at `distance`. Cameras whose view is not possible are left
// out.
std::vector<sobb_view> camera_views(const std::vector<SceneCamera>& cameras, double distance);

// From the centre c of the scene's box with half diagonal h: the eye at c + 2.2 h (0.48, 0.36,
// 0.8), looking at c, y up, 50 degrees.
sobb_view default_view(const Scene& scene);

}  // namespace sobb
