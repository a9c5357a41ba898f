// SPDX-License-Identifier: Apache-2.0
// See gltf.h.
#include "scene/gltf/gltf.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "scene/gltf/buffers/buffers.h"
#include "scene/gltf/buffers/glb.h"
#include "scene/gltf/document/document.h"
#include "scene/gltf/morph.h"
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
        morph_(document, buffers),
        nodes_(place_gltf_nodes(document, writer)),
        meshes_(document.model.meshes.size()) {}

  void read() {
    expect_all();
    const tinygltf::Model& model = document_.model;
    for_each_mesh([&](int mesh, const GltfPlacedNode& placed) {
      const tinygltf::Mesh& source = model.meshes[size_t(mesh)];
      const tinygltf::Node none;
      const tinygltf::Node& node = placed.node < 0 ? none : model.nodes[size_t(placed.node)];
      writer_.begin_mesh(source.name.empty() ? node.name : source.name);
      const std::vector<double>& weights = node.weights.empty() ? source.weights : node.weights;
      for (const GltfPrimitive& primitive : primitives(mesh)) {
        const std::span<const double> displacements =
            morph_.displacements(primitive.source(), weights, primitive.position_count());
        primitive.write(placed.transform, displacements, writer_);
      }
    });
    add_cameras();
    document_.faults.note(writer_);
  }

 private:
  using Primitives = std::vector<GltfPrimitive>;

  // Counts before anything is added: one mesh placed a thousand times is a thousand meshes in
  // memory.
  void expect_all() {
    uint64_t vertices = 0;
    uint64_t triangles = 0;
    for_each_mesh([&](int mesh, const GltfPlacedNode&) {
      for (const GltfPrimitive& primitive : primitives(mesh)) {
        writer_.work(1);
        vertices += primitive.vertex_count();
        triangles += primitive.triangle_count();
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
      if (mesh < 0) continue;
      if (size_t(mesh) >= meshes_.size()) {
        fail(SOBB_ERROR_SCENE_SYNTAX, "%s: nodes[%d] names no mesh, %d", writer_.name().c_str(),
             placed.node, mesh);
      }
      body(mesh, placed);
    }
  }

  // The mesh's primitives that have triangles, made at first use.
  const Primitives& primitives(int mesh) {
    std::optional<Primitives>& known = meshes_[size_t(mesh)];
    if (known) return *known;
    known.emplace();
    document_.faults.check(GltfItem::kMesh, size_t(mesh), writer_.name());
    const auto& sources = document_.model.meshes[size_t(mesh)].primitives;
    for (size_t i = 0; i < sources.size(); ++i) {
      if (sources[i].mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        fail(SOBB_ERROR_SCENE_SYNTAX, "%s: meshes[%d].primitives[%zu].mode is %d",
             writer_.name().c_str(), mesh, i, sources[i].mode);
      }
      if (!GltfPrimitive::has_triangles(sources[i]) || is_empty(mesh, i)) continue;
      known->push_back(GltfPrimitive::read(document_, buffers_, mesh, i));
      if (!known->back().has_surplus_corners()) continue;
      writer_.note(SOBB_NOTE_SHORT_FACE,
                   [&] { return known->back().place() + ": its last corners are no triangle"; });
    }
    return *known;
  }

  // Returns whether an accessor that the primitive needs has no elements, and notes that.
  bool is_empty(int mesh, size_t index) {
    if (document_.draco.count({mesh, index}) != 0) return false;
    const tinygltf::Primitive& source = document_.model.meshes[size_t(mesh)].primitives[index];
    for (const int accessor : {source.attributes.at("POSITION"), source.indices}) {
      if (accessor < 0 || document_.faults.has(GltfItem::kAccessor, size_t(accessor))) continue;
      if (document_.model.accessors[size_t(accessor)].count != 0) continue;
      writer_.note(SOBB_NOTE_UNUSED_ITEM,
                   [&] { return "accessors[" + std::to_string(accessor) + "] has no elements"; });
      return true;
    }
    return false;
  }

  // A glTF camera looks along its -z, y up.
  void add_cameras() {
    const tinygltf::Model& model = document_.model;
    const auto vec3 = [](const std::array<double, 3>& v) { return Vec3{v[0], v[1], v[2]}; };
    for (const GltfPlacedNode& placed : nodes_) {
      const int index = model.nodes[size_t(placed.node)].camera;
      if (index >= 0 && size_t(index) >= model.cameras.size()) {
        writer_.note(SOBB_NOTE_UNUSED_ITEM, [&] {
          return "nodes[" + std::to_string(placed.node) + "] names no camera, " +
                 std::to_string(index);
        });
        continue;
      }
      if (index < 0 || document_.faults.has(GltfItem::kCamera, size_t(index))) continue;
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
  GltfMorph morph_;
  std::vector<GltfPlacedNode> nodes_;
  std::vector<std::optional<Primitives>> meshes_;
};

}  // namespace

void read_gltf(std::string_view bytes, SceneWriter& writer) {
  GlbChunks chunks{bytes, std::nullopt};
  if (is_glb(bytes)) chunks = split_glb(bytes, writer);
  // Some writers pad JSON with zeros instead of spaces.
  while (chunks.json.ends_with('\0')) chunks.json.remove_suffix(1);
  if (chunks.json.starts_with("\xFF\xFE") || chunks.json.starts_with("\xFE\xFF")) {
    fail(SOBB_ERROR_SCENE_UNSUPPORTED, "%s: JSON in UTF-16: only UTF-8 is read",
         writer.name().c_str());
  }
  const GltfDocument document = parse_gltf(chunks.json, writer);
  GltfBuffers buffers(document, chunks.binary, writer);
  GltfReader(document, buffers, writer).read();
}

}  // namespace sobb
