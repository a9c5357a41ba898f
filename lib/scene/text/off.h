// SPDX-License-Identifier: Apache-2.0
// Reads Geomview OFF: the ASCII form of three dimensions.
#pragma once

#include <string_view>

#include "scene/model/scene_writer.h"

namespace sobb {

// Reads a whole file; the caller finishes the writer.
//
// The keyword is OFF with any of the prefixes ST (texture coordinates), C (colours) and N
// (normals); then the counts of vertices, faces and edges; then one line per vertex and one per
// face. What a vertex or a face has beyond its position or corners is ignored, but must be numbers,
// as many as the prefixes allow. Comments and empty lines may stand anywhere.
//
// Errors, with the line: SCENE_SYNTAX for a malformed line, a face of fewer than three corners,
// counts that the file cannot hold, or text after the last face; SCENE_UNSUPPORTED for binary OFF
// and for the prefixes 4 and n (other dimensions); INDEX for a corner that names no vertex; those
// of SceneWriter.
void read_off(std::string_view bytes, SceneWriter& writer);

}  // namespace sobb
