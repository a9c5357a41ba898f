// SPDX-License-Identifier: Apache-2.0
// Reads STL: binary and ASCII.
#pragma once

#include <string_view>

#include "scene/model/scene_writer.h"

namespace sobb {

// Reads a whole file; the caller finishes the writer.
//
// A file is binary where its size is exactly what the count at byte 80 asks for, whatever its
// header begins with; else it is ASCII. Every facet keeps three vertices of its own: equal ones
// are not merged, so that vertex 3 i + c is corner c of triangle i. Normals and attributes are
// ignored. Every solid of an ASCII file is a mesh, named as its line says.
//
// Errors, with the line or the triangle: SCENE_SYNTAX for a malformed line, a facet of other than
// three vertices, an unended solid, or a size that fits neither form; those of SceneWriter.
void read_stl(std::string_view bytes, SceneWriter& writer);

}  // namespace sobb
