// SPDX-License-Identifier: Apache-2.0
// Parses the JSON of a glTF file into TinyGLTF's model, without what is not geometry.
//
// The room gltf/document/ is all that sees the JSON: checked_json.h reads it strictly, extensions.h
// decides on extensions, geometry_filter.h takes what geometry needs for TinyGLTF, declared_views.h
// the buffers and their views, faults.h keeps what is malformed. The rest of gltf/ sees model.h.
#pragma once

#include <string_view>

#include "scene/gltf/document/model.h"
#include "scene/model/scene_writer.h"

namespace sobb {

// Malformed elements are faults of the document, which matter where a triangle needs one. Errors:
// SCENE_SYNTAX; SCENE_UNSUPPORTED with the version or extension; MEMORY_LIMIT before TinyGLTF would
// take more than the writer has left.
//
// TinyGLTF drops what it cannot parse, takes a fraction for a missing index, and trusts images to
// lie in their buffers. So it is given a document of ours, with the members that geometry needs,
// each of the type and range that the specification (glTF 2.0) says. TinyGLTF does not see the
// buffers either, which it would read at once, one copy each: GltfBuffers does that.
GltfDocument parse_gltf(std::string_view text, SceneWriter& writer);

}  // namespace sobb
