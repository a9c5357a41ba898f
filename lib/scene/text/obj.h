// SPDX-License-Identifier: Apache-2.0
// Reads Wavefront OBJ: vertices (v), faces (f), and the groups (g, o) that name them.
#pragma once

#include <string_view>

#include "scene/model/scene_writer.h"

namespace sobb {

// Reads a whole file; the caller finishes the writer.
//
// A polygon is any face of three or more corners, each v, v/vt, v//vn or v/vt/vn; indices count
// from 1, or backwards from the latest vertex so far where negative, and may name vertices that
// come later. What follows a slash must be an integer or nothing and is otherwise ignored, as are a
// vertex's weight and colour, and all other statements. Every o or g begins a mesh, named by the
// rest of its line. Keywords are of either case. More values of a vertex are passed over with a
// note.
//
// Errors, with the line: SCENE_SYNTAX for a malformed vertex or face, INDEX for a corner that names
// no vertex, SCENE_UNSUPPORTED for UTF-16; those of SceneWriter.
void read_obj(std::string_view bytes, SceneWriter& writer);

}  // namespace sobb
