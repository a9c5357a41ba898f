// SPDX-License-Identifier: Apache-2.0
// Reads PLY: ASCII, and binary of either order of bytes.
#pragma once

#include <string_view>

#include "scene/model/scene_writer.h"

namespace sobb {

// Reads a whole file; the caller finishes the writer.
//
// Vertices are element vertex, its properties x, y and z of any type. Faces are element face, its
// list vertex_indices or vertex_index, both of any integer types. Elements may come in any order;
// other elements and properties are passed over. In ASCII every item has a line of its own.
//
// Errors, with the line (in binary data, the element and its index): SCENE_SYNTAX for a malformed
// header or line, a face of fewer than three corners, counts that the file cannot hold, data
// missing or left over; SCENE_UNSUPPORTED for triangle strips and versions but 1.0; INDEX for a
// corner that names no vertex; those of SceneWriter.
void read_ply(std::string_view bytes, SceneWriter& writer);

}  // namespace sobb
