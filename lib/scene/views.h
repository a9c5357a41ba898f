// SPDX-License-Identifier: Apache-2.0
// The views of a scene: from a JSON file, from glTF cameras, or a default one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf/gltf.h"
#include "scene/scene.h"

namespace sobb {

// The views that the JSON text of the file at `path` has under `stem`; none if it has no such
// member. Errors: SCENE_SYNTAX with the file and the place; MEMORY_LIMIT, CANCELLED by the writer.
std::vector<sobb_view> parse_views(std::string_view text, const std::string& path,
                                   std::string_view stem, SceneWriter& writer);

// The same from the file. Errors: FILE_OPEN, FILE_READ too.
std::vector<sobb_view> read_views(const std::string& path, std::string_view stem,
                                  SceneWriter& writer);

// A glTF camera looks along its -z, y up. `distance` is that of the view's target. Nothing is made
// of cameras that see nothing: without a direction, an up or an angle.
std::vector<sobb_view> camera_views(const std::vector<GltfCamera>& cameras, double distance);

// From the centre c of the scene's box with half diagonal h: the eye at c + 2.2 h (0.48, 0.36,
// 0.8), looking at c, y up, 50 degrees.
sobb_view default_view(const Scene& scene);

double half_diagonal(const Scene& scene);

}  // namespace sobb
