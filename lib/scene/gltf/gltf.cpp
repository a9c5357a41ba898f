// SPDX-License-Identifier: Apache-2.0
// See gltf.h.
#include "scene/gltf/gltf.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "scene/gltf/buffers.h"
#include "scene/gltf/document/document.h"
#include "scene/gltf/glb.h"
#include "scene/gltf/nodes.h"
#include "scene/gltf/primitive.h"

namespace sobb {
namespace {

class GltfReader {
 public:
  GltfReader(const GltfDocument& document, GltfBuffers& buffers, SceneWriter& writer)
      : document_(document),
        buffers_(buffers),
        writer_(writer),
        nodes_(place_gltf_nodes(document.model, writer.name())),
        meshes_(document.model.meshes.size()) {}

  void read() {
    expect_all();
    const tinygltf::Model& model = document_.model;
    for_each_mesh([&](int mesh, const GltfPlacedNode& placed) {
      const std::string& name = model.meshes[size_t(mesh)].name;
      const bool named = !name.empty() || placed.node < 0;
      writer_.begin_mesh(named ? name : model.nodes[size_t(placed.node)].name);
      for (const auto& primitive : primitives(mesh)) primitive->write(placed.transform, writer_);
    });
    add_cameras();
  }

 private:
  using Primitives = std::vector<std::unique_ptr<GltfPrimitive>>;

  // Counts before anything is added: one mesh placed a thousand times is a thousand meshes in
  // memory.
  void expect_all() {
    uint64_t vertices = 0;
    uint64_t triangles = 0;
    for_each_mesh([&](int mesh, const GltfPlacedNode&) {
      for (const auto& primitive : primitives(mesh)) {
        writer_.work(1);
        vertices += primitive->vertex_count();
        triangles += primitive->triangle_count();
        writer_.check_counts(vertices, triangles);
      }
    });
    writer_.expect(vertices, triangles);
  }

  // Calls body(mesh, placed node) for each mesh as nodes place it. A file without nodes is a
  // library of meshes, which are taken as they are.
  template <class Body>
  void for_each_mesh(const Body& body) {
    if (document_.model.nodes.empty()) {
      for (size_t i = 0; i < meshes_.size(); ++i) body(int(i), GltfPlacedNode{});
    }
    for (const GltfPlacedNode& placed : nodes_) {
      const int mesh = document_.model.nodes[size_t(placed.node)].mesh;
      if (named_by(placed, mesh, meshes_.size(), "mesh")) body(mesh, placed);
    }
  }

  // Returns whether a node has element `index` of `count`; an index below zero is none. Error
  // SCENE_SYNTAX for an index beyond them.
  bool named_by(const GltfPlacedNode& placed, int index, size_t count, const char* what) const {
    if (index < 0) return false;
    if (size_t(index) < count) return true;
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: nodes[%d] names no %s, %d", writer_.name().c_str(),
         placed.node, what, index);
  }

  // The mesh's primitives that have triangles, made at first use.
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
      if (!GltfPrimitive::has_triangles(sources[i])) continue;
      known->push_back(
          std::make_unique<GltfPrimitive>(document_, buffers_, mesh, i, writer_.name()));
    }
    return *known;
  }

  // A glTF camera looks along its -z, y up.
  void add_cameras() const {
    const tinygltf::Model& model = document_.model;
    const auto vec3 = [](const std::array<double, 3>& v) { return Vec3{v[0], v[1], v[2]}; };
    for (const GltfPlacedNode& placed : nodes_) {
      const int index = model.nodes[size_t(placed.node)].camera;
      if (!named_by(placed, index, model.cameras.size(), "camera")) continue;
      const tinygltf::Camera& camera = model.cameras[size_t(index)];
      if (camera.type != "perspective") continue;
      const GltfTransform& transform = placed.transform;
      writer_.add_camera({vec3(transform.translation), vec3(transform.vector({0, 0, -1})),
                          vec3(transform.vector({0, 1, 0})), camera.perspective.yfov});
    }
  }

  const GltfDocument& document_;
  GltfBuffers& buffers_;
  SceneWriter& writer_;
  std::vector<GltfPlacedNode> nodes_;
  std::vector<std::optional<Primitives>> meshes_;
};

}  // namespace

void read_gltf(std::string_view bytes, SceneWriter& writer) {
  GlbChunks chunks{bytes, std::nullopt};
  if (is_glb(bytes)) chunks = split_glb(bytes, writer.name());
  const GltfDocument document = parse_gltf(chunks.json, writer);
  GltfBuffers buffers(document.buffers, chunks.binary, writer);
  GltfReader(document, buffers, writer).read();
}

}  // namespace sobb
