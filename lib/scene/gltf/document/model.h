// SPDX-License-Identifier: Apache-2.0
// What is kept of a glTF's JSON: TinyGLTF's data model, whose header is included only here, and the
// buffers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop

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

}  // namespace sobb
