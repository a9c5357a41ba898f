// SPDX-License-Identifier: Apache-2.0
// Decides which glTF extensions a file may use and require.
#pragma once

#include "scene/gltf/document/checked_json.h"
#include "scene/model/scene_writer.h"

namespace sobb {

// Returns whether the document lists the extension as used or required.
bool uses_extension(const CheckedJson& json, const char* extension);

// Checks what the document lists. An extension that is required, not read, and moves no triangle is
// noted. Error SCENE_UNSUPPORTED, with the extension's name, for one that is required and may
// change the triangles that are there, and for one without which triangles would be lost.
void check_extensions(const CheckedJson& json, SceneWriter& writer);

}  // namespace sobb
