// SPDX-License-Identifier: Apache-2.0
// See primitive.h.
#include "scene/gltf/primitive.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/error.h"
#include "scene/gltf/buffers/draco.h"

namespace sobb {
namespace {

using Use = GltfAccessor::Use;

// Returns whether an accessor has elements that need no decompression.
bool has_elements(const GltfDocument& document, int accessor) {
  if (accessor < 0) return true;  // no indices are no elements to miss
  const tinygltf::Accessor& source = document.model.accessors[size_t(accessor)];
  return source.sparse.isSparse || size_t(source.bufferView) < document.views.size();
}

}  // namespace

GltfPrimitive GltfPrimitive::read(const GltfDocument& document, GltfBuffers& buffers, int mesh,
                                  size_t index) {
  const tinygltf::Primitive& source = document.model.meshes[size_t(mesh)].primitives[index];
  std::string place =
      "meshes[" + std::to_string(mesh) + "].primitives[" + std::to_string(index) + "]";
  const int positions = source.attributes.at("POSITION");
  const auto compressed = document.draco.find({mesh, index});
  if (compressed != document.draco.end()) {
    // A primitive may have its triangles in accessors too, for readers that cannot decompress.
    const bool fallback = !can_decode_draco() && has_elements(document, positions) &&
                          has_elements(document, source.indices);
    if (!fallback) return decode(document, buffers, source, std::move(place), compressed->second);
  }
  GltfAccessor vertices = GltfAccessor::read(document, buffers, positions, Use::kPositions);
  std::optional<GltfAccessor> indices;
  if (source.indices >= 0) {
    indices = GltfAccessor::read(document, buffers, source.indices, Use::kIndices);
  }
  return {source, std::move(place), source.mode, std::move(vertices), std::move(indices)};
}

GltfPrimitive GltfPrimitive::decode(const GltfDocument& document, GltfBuffers& buffers,
                                    const tinygltf::Primitive& source, std::string place,
                                    const GltfDraco& compressed) {
  std::string_view data;
  if (can_decode_draco()) {
    if (size_t(compressed.view) >= document.views.size()) {
      fail(SOBB_ERROR_SCENE_SYNTAX, "%s: %s: KHR_draco_mesh_compression names no bufferView, %d",
           buffers.writer().name().c_str(), place.c_str(), compressed.view);
    }
    data = buffers.view(size_t(compressed.view)).bytes;
  }
  DracoTriangles decoded = decode_draco(data, compressed.position_id, place, buffers.writer());
  GltfElements vertices;
  vertices.count = decoded.point_count;
  vertices.component_type = decoded.component_type;
  vertices.normalized =
      document.model.accessors[size_t(source.attributes.at("POSITION"))].normalized;
  vertices.stride = decoded.point_count == 0 ? 0 : decoded.positions.size() / decoded.point_count;
  vertices.owned = std::move(decoded.positions);
  GltfElements indices;
  indices.count = 3 * decoded.triangle_count;
  indices.component_type = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  indices.stride = sizeof(uint32_t);
  indices.owned = std::move(decoded.indices);
  return {source, std::move(place), TINYGLTF_MODE_TRIANGLES, GltfAccessor(std::move(vertices)),
          GltfAccessor(std::move(indices))};
}

uint64_t GltfPrimitive::triangle_count() const {
  const uint64_t corners = corner_count();
  if (mode_ == TINYGLTF_MODE_TRIANGLES) return corners / 3;
  return corners < 3 ? 0 : corners - 2;
}

uint64_t GltfPrimitive::vertex_count() const {
  return std::min(corner_count(), positions_.count());
}

bool GltfPrimitive::has_surplus_corners() const {
  return mode_ == TINYGLTF_MODE_TRIANGLES ? corner_count() % 3 != 0 : corner_count() < 3;
}

void GltfPrimitive::write(const GltfTransform& transform, std::span<const double> displacements,
                          SceneWriter& writer) const {
  writer.work(1);
  const auto add_vertex = [&](uint64_t i) {
    std::array<double, 3> p = positions_.position(i);
    if (!displacements.empty()) {
      for (size_t k = 0; k < 3; ++k) p[k] += displacements[3 * i + k];
    }
    if (!transform.identity) p = transform.point(p);
    writer.add_vertex(p[0], p[1], p[2], [&] { return place_ + ", vertex " + std::to_string(i); });
  };
  const uint64_t base = writer.vertex_count();
  if (corner_count() >= positions_.count()) {
    for (uint64_t i = 0; i < positions_.count(); ++i) add_vertex(i);
    write_triangles([&](uint64_t i) { return base + vertex_of_corner(i, writer); }, writer);
    return;
  }
  // Many primitives may share one large accessor: each takes only the vertices that it uses.
  writer.check_room(positions_.count() * sizeof(uint32_t));
  writer.work(positions_.count() / 8);
  std::vector<uint32_t> places(positions_.count(), UINT32_MAX);  // within this primitive
  uint32_t taken = 0;
  const auto corner = [&](uint64_t i) {
    const uint64_t vertex = vertex_of_corner(i, writer);
    if (places[vertex] == UINT32_MAX) {
      add_vertex(vertex);
      places[vertex] = taken++;
    }
    return base + places[vertex];
  };
  write_triangles(corner, writer);
}

uint64_t GltfPrimitive::vertex_of_corner(uint64_t i, const SceneWriter& writer) const {
  if (!indices_) return i;
  const uint64_t vertex = indices_->index(i);
  if (vertex >= positions_.count()) {
    fail(SOBB_ERROR_INDEX, "%s: %s: index %llu names vertex %llu of %llu", writer.name().c_str(),
         place_.c_str(), static_cast<unsigned long long>(i),
         static_cast<unsigned long long>(vertex),
         static_cast<unsigned long long>(positions_.count()));
  }
  return vertex;
}

// The corners of triangle t depend on the mode (specification, section 3.7.2.1).
template <class Corner>
void GltfPrimitive::write_triangles(const Corner& corner, SceneWriter& writer) const {
  const uint64_t triangles = triangle_count();
  for (uint64_t t = 0; t < triangles; ++t) {
    std::array<uint64_t, 3> order{3 * t, 3 * t + 1, 3 * t + 2};
    if (mode_ == TINYGLTF_MODE_TRIANGLE_STRIP) order = {t, t + 1 + t % 2, t + 2 - t % 2};
    if (mode_ == TINYGLTF_MODE_TRIANGLE_FAN) order = {t + 1, t + 2, 0};
    const uint64_t corners[3] = {corner(order[0]), corner(order[1]), corner(order[2])};
    writer.add_polygon(corners, [&] { return place_; });
  }
}

}  // namespace sobb
