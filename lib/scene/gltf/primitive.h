// SPDX-License-Identifier: Apache-2.0
// Writes the triangles of a glTF mesh's primitive (specification, section 3.7.2).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "scene/gltf/accessor.h"
#include "scene/gltf/nodes.h"
#include "scene/model/scene_writer.h"

namespace sobb {

// A primitive that is made of triangles, with its accessors proven.
class GltfPrimitive {
 public:
  // Points and lines have no triangles, nor has what has no positions.
  static bool has_triangles(const tinygltf::Primitive& primitive) {
    return primitive.mode >= TINYGLTF_MODE_TRIANGLES && primitive.attributes.count("POSITION") != 0;
  }

  // Primitive `index` of mesh `mesh`, which has triangles. Errors: SCENE_SYNTAX, and those of
  // GltfAccessor.
  GltfPrimitive(const GltfDocument& document, GltfBuffers& buffers, int mesh, size_t index,
                const std::string& name);

  // What write() adds at most.
  uint64_t triangle_count() const;
  uint64_t vertex_count() const;

  // Adds the vertices, transformed, and the triangles. Errors: INDEX for an index that names no
  // vertex; those of SceneWriter.
  void write(const GltfTransform& transform, SceneWriter& writer) const;

 private:
  uint64_t corner_count() const { return indices_ ? indices_->count() : positions_.count(); }
  uint64_t vertex_of_corner(uint64_t i) const;
  void add_vertex(uint64_t i, const GltfTransform& transform, SceneWriter& writer) const;
  template <class Corner>
  void write_triangles(const Corner& corner, SceneWriter& writer) const;

  const std::string& name_;
  std::string place_;
  int mode_;
  GltfAccessor positions_;
  std::optional<GltfAccessor> indices_;
};

}  // namespace sobb
