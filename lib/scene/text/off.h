// SPDX-License-Identifier: Apache-2.0
// Reads Geomview OFF: the ASCII form of three dimensions.
#pragma once

#include <string_view>

#include "scene/model/scene_writer.h"

namespace sobb {

// Reads a whole file; the caller finishes the writer.
//
// The keyword is OFF with any of the prefixes ST (texture coordinates), C (colours) and N
// (normals), or missing; then the counts of vertices, faces and edges, the last of which may be
// missing; then one line per vertex and one per face. What a vertex has beyond its position is
// ignored, with a note where the prefixes do not allow it, as is what follows a face's corners and
// what follows the last face. Comments and empty lines may stand anywhere.
//
// Errors, with the line: SCENE_SYNTAX for a malformed line or counts that the file cannot hold;
// SCENE_UNSUPPORTED for binary OFF, for the prefixes 4 and n (other dimensions) and for UTF-16;
// INDEX for a corner that names no vertex; those of SceneWriter.
void read_off(std::string_view bytes, SceneWriter& writer);

}  // namespace sobb
