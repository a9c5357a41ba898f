// SPDX-License-Identifier: Apache-2.0
// Writes the triangles of a glTF mesh's primitive (specification, section 3.7.2).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

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

  // Primitive `index` of mesh `mesh`, which has triangles. The document and its buffers outlive it.
  // Errors: those of GltfAccessor::read() and decode_draco().
  static GltfPrimitive read(const GltfDocument& document, GltfBuffers& buffers, int mesh,
                            size_t index);

  const tinygltf::Primitive& source() const { return source_; }
  const std::string& place() const { return place_; }
  uint64_t position_count() const { return positions_.count(); }

  // What write() adds at most.
  uint64_t triangle_count() const;
  uint64_t vertex_count() const;
  // Corners that make no whole triangle.
  bool has_surplus_corners() const;

  // Adds the vertices, displaced and then transformed, and the triangles. `displacements` has x, y
  // and z per position, or nothing. Errors: INDEX for an index that names no vertex; those of
  // SceneWriter.
  void write(const GltfTransform& transform, std::span<const double> displacements,
             SceneWriter& writer) const;

 private:
  GltfPrimitive(const tinygltf::Primitive& source, std::string place, int mode,
                GltfAccessor positions, std::optional<GltfAccessor> indices)
      : source_(source),
        place_(std::move(place)),
        mode_(mode),
        positions_(std::move(positions)),
        indices_(std::move(indices)) {}
  static GltfPrimitive decode(const GltfDocument& document, GltfBuffers& buffers,
                              const tinygltf::Primitive& source, std::string place,
                              const GltfDraco& compressed);

  uint64_t corner_count() const { return indices_ ? indices_->count() : positions_.count(); }
  uint64_t vertex_of_corner(uint64_t i, const SceneWriter& writer) const;
  template <class Corner>
  void write_triangles(const Corner& corner, SceneWriter& writer) const;

  const tinygltf::Primitive& source_;
  std::string place_;
  int mode_;
  GltfAccessor positions_;
  std::optional<GltfAccessor> indices_;
};

}  // namespace sobb
