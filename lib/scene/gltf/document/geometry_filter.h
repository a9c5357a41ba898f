// SPDX-License-Identifier: Apache-2.0
// Takes from a glTF's JSON the members that geometry needs: nodes, meshes, accessors and cameras.
#pragma once

#include "scene/gltf/document/checked_json.h"
#include "scene/gltf/document/model.h"
#include "scene/model/scene_writer.h"

namespace sobb {

// Returns a document with only those members, each of its type and range, and each naming elements
// that exist, so that TinyGLTF takes all of it. A malformed element is a fault of `document`, and a
// placeholder stands for it. Of `document`, buffers and views come before, and what TinyGLTF does
// not read is added. Errors: SCENE_SYNTAX, with the place, where an array is none; CANCELLED.
nlohmann::json geometry_of(const CheckedJson& source, GltfDocument& document, SceneWriter& writer);

}  // namespace sobb
