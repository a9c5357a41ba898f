// SPDX-License-Identifier: Apache-2.0
// Reads glTF 2.0, as .gltf or .glb: every triangle and camera as placed.
//
// The room gltf/ shows the way of a file: buffers/ splits a container, fetches bytes and
// decompresses them, document/ parses the JSON, accessor.h reads elements, nodes.h places the
// meshes, primitive.h writes their triangles, displaced as morph.h says.
#pragma once

#include <string_view>

#include "scene/model/scene_writer.h"

namespace sobb {

// Reads a whole file; the caller finishes the writer, whose name is the file's path: buffers beside
// the file are found by it. Points, lines and primitives without positions are ignored. Errors:
// SCENE_SYNTAX, SCENE_UNSUPPORTED, SCENE_REFERENCE, and those of SceneWriter.
void read_gltf(std::string_view bytes, SceneWriter& writer);

}  // namespace sobb
