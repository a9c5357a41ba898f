// SPDX-License-Identifier: Apache-2.0
// Takes from a glTF's JSON the members that geometry needs: nodes, meshes, accessors, cameras, and
// the buffers apart.
#pragma once

#include <vector>

#include "scene/gltf/document/checked_json.h"
#include "scene/gltf/document/model.h"

namespace sobb {

// A document with only those members, each of its type and range. Error SCENE_SYNTAX with the
// element's place.
nlohmann::json geometry_of(const CheckedJson& source);

// The buffers as declared. Error SCENE_SYNTAX as above.
std::vector<GltfBuffer> declared_buffers(const CheckedJson& source);

}  // namespace sobb
