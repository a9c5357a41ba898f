// SPDX-License-Identifier: Apache-2.0
// Reads STL: binary and ASCII.
#pragma once

#include <string_view>

#include "scene/model/scene_writer.h"

namespace sobb {

// Reads a whole file; the caller finishes the writer.
//
// A file is binary where its size is exactly what the count at byte 80 asks for, or where that is
// zero and the size fits some count, whatever its header begins with; ASCII where it begins with
// solid or facet and has no zero byte in the first 84; else binary, with bytes after the last
// triangle that are passed over with a note.
//
// Every facet keeps its own vertices: equal ones are not merged, so that vertex 3 i + c is corner c
// of triangle i where all facets have three. Normals and attributes are ignored. Every solid of an
// ASCII file is a mesh, named as its line says. Statements that end a loop, facet or solid may be
// missing, in two words, or glued to a name.
//
// Errors, with the line or the triangle: SCENE_SYNTAX for a malformed statement, a facet that the
// file ends in, or a size too small for the count; SCENE_UNSUPPORTED for UTF-16; those of
// SceneWriter.
void read_stl(std::string_view bytes, SceneWriter& writer);

}  // namespace sobb
