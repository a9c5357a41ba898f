// SPDX-License-Identifier: Apache-2.0
// Reads PLY: ASCII, and binary of either order of bytes.
#pragma once

#include <string_view>

#include "scene/model/scene_writer.h"

namespace sobb {

// Reads a whole file; the caller finishes the writer.
//
// Vertices are element vertex, its properties x, y and z of any type. Faces are element face, its
// list vertex_indices or vertex_index, both of any integer types; triangle strips are the same list
// of element tristrips, where -1 ends a strip. Elements may come in any order; other elements and
// properties are passed over. In ASCII every item has a line of its own. Values that a line has
// left and data that the header does not declare are passed over with a note.
//
// Errors, with the line (in binary data, the element and its index): SCENE_SYNTAX for a malformed
// header or line, counts that the file cannot hold, or data missing; SCENE_UNSUPPORTED for versions
// but 1.0 and for UTF-16; INDEX for a corner that names no vertex; those of SceneWriter.
void read_ply(std::string_view bytes, SceneWriter& writer);

}  // namespace sobb
