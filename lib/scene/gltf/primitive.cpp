// SPDX-License-Identifier: Apache-2.0
// See primitive.h.
#include "scene/gltf/primitive.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/error.h"

namespace sobb {
namespace {

const tinygltf::Primitive& source_of(const GltfDocument& document, int mesh, size_t index) {
  return document.model.meshes[size_t(mesh)].primitives[index];
}

}  // namespace

GltfPrimitive::GltfPrimitive(const GltfDocument& document, GltfBuffers& buffers, int mesh,
                             size_t index, const std::string& name)
    : name_(name),
      place_("meshes[" + std::to_string(mesh) + "].primitives[" + std::to_string(index) + "]"),
      mode_(source_of(document, mesh, index).mode),
      positions_(document, buffers, source_of(document, mesh, index).attributes.at("POSITION"),
                 GltfAccessor::Use::kPositions, name) {
  const int indices = source_of(document, mesh, index).indices;
  if (indices >= 0) {
    indices_.emplace(document, buffers, indices, GltfAccessor::Use::kIndices, name);
  }
  const uint64_t count = corner_count();
  if (count < 3 || (mode_ == TINYGLTF_MODE_TRIANGLES && count % 3 != 0)) {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: %s has %llu corners, no whole triangles", name.c_str(),
         place_.c_str(), static_cast<unsigned long long>(count));
  }
}

uint64_t GltfPrimitive::triangle_count() const {
  return mode_ == TINYGLTF_MODE_TRIANGLES ? corner_count() / 3 : corner_count() - 2;
}

uint64_t GltfPrimitive::vertex_count() const {
  return std::min(corner_count(), positions_.count());
}

void GltfPrimitive::write(const GltfTransform& transform, SceneWriter& writer) const {
  writer.work(1);
  const uint64_t base = writer.vertex_count();
  if (corner_count() >= positions_.count()) {
    for (uint64_t i = 0; i < positions_.count(); ++i) add_vertex(i, transform, writer);
    write_triangles([&](uint64_t i) { return base + vertex_of_corner(i); }, writer);
    return;
  }
  // Many primitives may share one large accessor: each takes only the vertices that it uses.
  writer.check_room(positions_.count() * sizeof(uint32_t));
  writer.work(positions_.count() / 8);
  std::vector<uint32_t> places(positions_.count(), UINT32_MAX);  // within this primitive
  uint32_t taken = 0;
  const auto corner = [&](uint64_t i) {
    const uint64_t vertex = vertex_of_corner(i);
    if (places[vertex] == UINT32_MAX) {
      add_vertex(vertex, transform, writer);
      places[vertex] = taken++;
    }
    return base + places[vertex];
  };
  write_triangles(corner, writer);
}

uint64_t GltfPrimitive::vertex_of_corner(uint64_t i) const {
  if (!indices_) return i;
  const uint64_t vertex = indices_->index(i);
  if (vertex >= positions_.count()) {
    fail(SOBB_ERROR_INDEX, "%s: %s: index %llu names vertex %llu of %llu", name_.c_str(),
         place_.c_str(), static_cast<unsigned long long>(i),
         static_cast<unsigned long long>(vertex),
         static_cast<unsigned long long>(positions_.count()));
  }
  return vertex;
}

void GltfPrimitive::add_vertex(uint64_t i, const GltfTransform& transform,
                               SceneWriter& writer) const {
  std::array<double, 3> p = positions_.position(i);
  if (!transform.identity) p = transform.point(p);
  writer.add_vertex(float(p[0]), float(p[1]), float(p[2]),
                    [&] { return place_ + ", vertex " + std::to_string(i); });
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
