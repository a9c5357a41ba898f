// SPDX-License-Identifier: Apache-2.0
// See gltf.h.
#include "scene/gltf/gltf.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "base/error.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/buffers.h"
#include "scene/gltf/document.h"
#include "scene/gltf/glb.h"

namespace sobb {
namespace {

// A mesh's primitive that is made of triangles, with its accessors proven.
class Primitive {
 public:
  Primitive(const GltfDocument& document, GltfBuffers& buffers, int mesh, size_t index,
            const std::string& name)
      : name_(name),
        place_("meshes[" + std::to_string(mesh) + "].primitives[" + std::to_string(index) + "]"),
        mode_(source(document, mesh, index).mode),
        positions_(document, buffers, source(document, mesh, index).attributes.at("POSITION"),
                   GltfAccessor::Use::kPositions, name) {
    const int indices = source(document, mesh, index).indices;
    if (indices >= 0) {
      indices_.emplace(document, buffers, indices, GltfAccessor::Use::kIndices, name);
    }
    const uint64_t count = corner_count();
    if (count < 3 || (mode_ == TINYGLTF_MODE_TRIANGLES && count % 3 != 0)) {
      fail(SOBB_ERROR_SCENE_SYNTAX, "%s: %s has %llu corners, no whole triangles", name.c_str(),
           place_.c_str(), static_cast<unsigned long long>(count));
    }
  }

  // Points and lines have no triangles, and without positions nothing is there.
  static bool has_triangles(const tinygltf::Primitive& primitive) {
    return primitive.mode >= TINYGLTF_MODE_TRIANGLES && primitive.attributes.count("POSITION") != 0;
  }

  uint64_t triangle_count() const {
    return mode_ == TINYGLTF_MODE_TRIANGLES ? corner_count() / 3 : corner_count() - 2;
  }
  // Where many primitives share one large accessor, each takes only the vertices that it uses.
  bool takes_all_vertices() const { return corner_count() >= positions_.count(); }
  uint64_t vertex_count() const { return std::min(corner_count(), positions_.count()); }

  void write(const GltfTransform& transform, SceneWriter& writer) const {
    writer.work(1);
    const uint64_t base = writer.vertex_count();
    if (takes_all_vertices()) {
      for (uint64_t i = 0; i < positions_.count(); ++i) add_vertex(i, transform, writer);
      write_triangles([&](uint64_t i) { return base + checked(i); }, writer);
      return;
    }
    writer.check_room(positions_.count() * sizeof(uint32_t));
    writer.work(positions_.count() / 8);
    std::vector<uint32_t> places(positions_.count(), UINT32_MAX);  // within this primitive
    uint32_t taken = 0;
    const auto corner = [&](uint64_t i) {
      const uint64_t vertex = checked(i);
      if (places[vertex] == UINT32_MAX) {
        add_vertex(vertex, transform, writer);
        places[vertex] = taken++;
      }
      return base + places[vertex];
    };
    write_triangles(corner, writer);
  }

 private:
  static const tinygltf::Primitive& source(const GltfDocument& document, int mesh, size_t index) {
    return document.model.meshes[size_t(mesh)].primitives[index];
  }

  uint64_t corner_count() const { return indices_ ? indices_->count() : positions_.count(); }

  uint64_t checked(uint64_t i) const {
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

  void add_vertex(uint64_t i, const GltfTransform& transform, SceneWriter& writer) const {
    std::array<double, 3> p = positions_.position(i);
    if (!transform.identity) p = transform.point(p);
    writer.add_vertex(float(p[0]), float(p[1]), float(p[2]),
                      [&] { return place_ + ", vertex " + std::to_string(i); });
  }

  // Corners of triangle t by mode (specification, section 3.7.2.1).
  template <class Corner>
  void write_triangles(const Corner& corner, SceneWriter& writer) const {
    const uint64_t triangles = triangle_count();
    for (uint64_t t = 0; t < triangles; ++t) {
      std::array<uint64_t, 3> order{3 * t, 3 * t + 1, 3 * t + 2};
      if (mode_ == TINYGLTF_MODE_TRIANGLE_STRIP) order = {t, t + 1 + t % 2, t + 2 - t % 2};
      if (mode_ == TINYGLTF_MODE_TRIANGLE_FAN) order = {t + 1, t + 2, 0};
      const uint64_t corners[3] = {corner(order[0]), corner(order[1]), corner(order[2])};
      writer.add_polygon(corners, [&] { return place_; });
    }
  }

  const std::string& name_;
  std::string place_;
  int mode_;
  GltfAccessor positions_;
  std::optional<GltfAccessor> indices_;
};

class GltfReader {
 public:
  GltfReader(const GltfDocument& document, GltfBuffers& buffers, SceneWriter& writer)
      : document_(document), buffers_(buffers), writer_(writer) {}

  std::vector<GltfCamera> run() {
    const tinygltf::Model& model = document_.model;
    const std::vector<GltfPlacedNode> nodes = place_gltf_nodes(model, writer_.name());
    meshes_.resize(model.meshes.size());

    // Counted first: one mesh placed a thousand times is a thousand meshes in memory.
    uint64_t vertices = 0;
    uint64_t triangles = 0;
    for_each_mesh(nodes, [&](int mesh, const GltfPlacedNode&) {
      for (const auto& primitive : primitives(mesh)) {
        writer_.work(1);
        vertices += primitive->vertex_count();
        triangles += primitive->triangle_count();
        writer_.check_counts(vertices, triangles);
      }
    });
    writer_.expect(vertices, triangles);
    for_each_mesh(nodes, [&](int mesh, const GltfPlacedNode& placed) {
      const std::string& name = model.meshes[size_t(mesh)].name;
      const bool named = !name.empty() || placed.node < 0;
      writer_.begin_mesh(named ? name : model.nodes[size_t(placed.node)].name);
      for (const auto& primitive : primitives(mesh)) primitive->write(placed.transform, writer_);
    });
    return cameras(nodes);
  }

 private:
  // Meshes as nodes place them; a file without nodes is a library of meshes, taken as they are.
  template <class Body>
  void for_each_mesh(const std::vector<GltfPlacedNode>& nodes, const Body& body) {
    if (document_.model.nodes.empty()) {
      for (size_t i = 0; i < meshes_.size(); ++i) body(int(i), GltfPlacedNode{});
    }
    for (const GltfPlacedNode& placed : nodes) {
      const int mesh = document_.model.nodes[size_t(placed.node)].mesh;
      if (mesh < 0) continue;
      if (size_t(mesh) >= meshes_.size()) {
        fail(SOBB_ERROR_SCENE_SYNTAX, "%s: nodes[%d] names no mesh, %d", writer_.name().c_str(),
             placed.node, mesh);
      }
      body(mesh, placed);
    }
  }

  using Primitives = std::vector<std::unique_ptr<Primitive>>;

  const Primitives& primitives(int mesh) {
    std::optional<Primitives>& known = meshes_[size_t(mesh)];
    if (known) return *known;
    known.emplace();
    const auto& sources = document_.model.meshes[size_t(mesh)].primitives;
    for (size_t i = 0; i < sources.size(); ++i) {
      if (sources[i].mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        fail(SOBB_ERROR_SCENE_SYNTAX, "%s: meshes[%d].primitives[%zu].mode is %d",
             writer_.name().c_str(), mesh, i, sources[i].mode);
      }
      if (!Primitive::has_triangles(sources[i])) continue;
      known->push_back(std::make_unique<Primitive>(document_, buffers_, mesh, i, writer_.name()));
    }
    return *known;
  }

  std::vector<GltfCamera> cameras(const std::vector<GltfPlacedNode>& nodes) const {
    const tinygltf::Model& model = document_.model;
    std::vector<GltfCamera> result;
    for (const GltfPlacedNode& placed : nodes) {
      const int index = model.nodes[size_t(placed.node)].camera;
      if (index < 0) continue;
      if (size_t(index) >= model.cameras.size()) {
        fail(SOBB_ERROR_SCENE_SYNTAX, "%s: nodes[%d] names no camera, %d", writer_.name().c_str(),
             placed.node, index);
      }
      const tinygltf::Camera& camera = model.cameras[size_t(index)];
      if (camera.type == "perspective") {
        result.push_back({placed.transform, camera.perspective.yfov});
      }
    }
    return result;
  }

  const GltfDocument& document_;
  GltfBuffers& buffers_;
  SceneWriter& writer_;
  std::vector<std::optional<Primitives>> meshes_;
};

}  // namespace

std::vector<GltfCamera> read_gltf(std::string_view bytes, std::string_view path,
                                  SceneWriter& writer) {
  GlbChunks chunks{bytes, std::nullopt};
  if (is_glb(bytes)) chunks = split_glb(bytes, writer.name());
  const GltfDocument document = parse_gltf(chunks.json, writer);
  GltfBuffers buffers(document.buffers, path, chunks.binary, writer);
  return GltfReader(document, buffers, writer).run();
}

}  // namespace sobb
