// SPDX-License-Identifier: Apache-2.0
// The JSON of a glTF file, as TinyGLTF's model, without all that is not geometry.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf/model.h"
#include "scene/scene_writer.h"

namespace sobb {

struct GltfBuffer {
  uint64_t byte_length = 0;
  std::string uri;  // empty for the binary chunk of a GLB
};

struct GltfDocument {
  tinygltf::Model model;            // its buffers, images and materials are empty
  std::vector<GltfBuffer> buffers;  // as declared
  bool quantized = false;           // KHR_mesh_quantization: positions may be integers
};

// Errors: SCENE_SYNTAX with the element's place, SCENE_UNSUPPORTED with the extension; MEMORY_LIMIT
// before TinyGLTF would take more than the writer has left.
//
// TinyGLTF drops what it cannot parse, takes a fraction for a missing index, and trusts images to
// lie in their buffers. So it is given a document of ours, with the members that geometry needs,
// each of the type and range that the specification (glTF 2.0) says. Nor does it see the buffers,
// which it would read at once, one copy each: GltfBuffers does that.
GltfDocument parse_gltf(std::string_view text, SceneWriter& writer);

}  // namespace sobb
