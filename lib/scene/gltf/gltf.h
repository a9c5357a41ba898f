// SPDX-License-Identifier: Apache-2.0
// Reads glTF 2.0, as .gltf or .glb: every triangle as placed, and the cameras.
#pragma once

#include <string_view>
#include <vector>

#include "scene/gltf/nodes.h"
#include "scene/scene_writer.h"

namespace sobb {

// A perspective camera as placed: its node's transform, and its vertical angle in radians.
struct GltfCamera {
  GltfTransform transform;
  double vfov = 0;
};

// `bytes` is the file at `path`. Points, lines and primitives without positions are ignored.
// Errors: SCENE_SYNTAX, SCENE_UNSUPPORTED, SCENE_REFERENCE, and those of SceneWriter. Returns the
// cameras.
std::vector<GltfCamera> read_gltf(std::string_view bytes, std::string_view path,
                                  SceneWriter& writer);

}  // namespace sobb
