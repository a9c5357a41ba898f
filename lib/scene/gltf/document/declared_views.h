// SPDX-License-Identifier: Apache-2.0
// Takes the buffers and buffer views from a glTF's JSON, which TinyGLTF does not see.
#pragma once

#include <vector>

#include "scene/gltf/document/checked_json.h"
#include "scene/gltf/document/model.h"

namespace sobb {

// Both return the elements as declared; those that are malformed are among the faults. Error
// SCENE_SYNTAX where there is no array of them.
std::vector<GltfBuffer> declared_buffers(const CheckedJson& source, GltfFaults& faults);
std::vector<GltfView> declared_views(const CheckedJson& source, GltfFaults& faults);

}  // namespace sobb
