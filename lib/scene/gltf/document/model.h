// SPDX-License-Identifier: Apache-2.0
// What is kept of a glTF's JSON: TinyGLTF's data model, whose header is included only here, and
// what TinyGLTF does not read or reads otherwise.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/gltf/document/faults.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop

namespace sobb {

struct GltfBuffer {
  uint64_t byte_length = 0;
  std::string uri;  // empty for the binary chunk of a GLB
};

// The elements of a buffer view, compressed by EXT_meshopt_compression or KHR_meshopt_compression.
struct GltfMeshopt {
  const char* extension = "";
  int buffer = 0;
  uint64_t byte_offset = 0;
  uint64_t byte_length = 0;
  uint64_t byte_stride = 0;
  uint64_t count = 0;
  std::string mode;
  std::string filter;
};

struct GltfView {
  int buffer = 0;
  uint64_t byte_offset = 0;
  uint64_t byte_length = 0;
  uint64_t byte_stride = 0;  // 0 for elements without gaps
  std::optional<GltfMeshopt> compressed;
};

// A primitive's triangles, compressed by KHR_draco_mesh_compression.
struct GltfDraco {
  int view = 0;
  uint32_t position_id = 0;  // Draco's unique id of the attribute POSITION
};

struct GltfDocument {
  // Its buffers, images and materials are empty. It has a buffer view more than the document: an
  // accessor without a view names that one, since TinyGLTF refuses indices that name none.
  tinygltf::Model model;
  std::vector<GltfBuffer> buffers;                    // as declared
  std::vector<GltfView> views;                        // as declared
  std::map<std::pair<int, size_t>, GltfDraco> draco;  // by mesh and primitive
  std::vector<bool> hidden;                           // nodes that KHR_node_visibility hides
  bool quantized = false;  // KHR_mesh_quantization: positions may be integers
  GltfFaults faults;
};

}  // namespace sobb
