// SPDX-License-Identifier: Apache-2.0
// See loop_subdivision.h.
#include "scene/subdivision/loop_subdivision.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <utility>

#include "base/error.h"
#include "scene/model/scene_writer.h"
#include "scene/subdivision/manifold_corners.h"

namespace sobb {
namespace {

// OpenMesh numbers halfedges, two per edge, by int.
constexpr uint64_t kMostEdges = uint64_t(1) << 30;

struct Counts {
  uint64_t vertices;
  uint64_t edges;
  uint64_t triangles;

  // The counts after one more subdivision: each edge is halved, and each triangle gets three edges
  // within.
  Counts subdivided() const { return {vertices + edges, 2 * edges + 3 * triangles, 4 * triangles}; }
};

// A mesh in double, since positions are rounded once, at the end. It reports progress in the
// functions that OpenMesh's LoopT calls for each vertex, edge and triangle.
class ReportingMesh : public OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble> {
 public:
  ReportingMesh(SceneWriter& writer, uint64_t work) : writer_(writer), work_(work) {}

  bool is_boundary(VertexHandle vertex) const { return report(), Base::is_boundary(vertex); }
  bool is_boundary(EdgeHandle edge) const { return report(), Base::is_boundary(edge); }
  bool is_boundary(HalfedgeHandle halfedge) const { return Base::is_boundary(halfedge); }
  FaceHandle new_face() { return report(), Base::new_face(); }

 private:
  using Base = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

  void report() const {
    constexpr uint64_t kReportEvery = 1 << 14;
    if (++done_ % kReportEvery == 0) writer_.reach(double(done_) / double(work_));
  }

  SceneWriter& writer_;
  uint64_t work_;
  mutable uint64_t done_ = 0;
};

// Weights are in float: where another machine's cosine differs, those bits are rounded off.
class Loop : public OpenMesh::Subdivider::Uniform::LoopT<ReportingMesh, float> {
 public:
  explicit Loop(const Counts& end) : end_(end) {}

 private:
  // LoopT adds properties of vertices and edges, whose arrays must not move either as they grow.
  bool prepare(ReportingMesh& mesh) override {
    LoopT::prepare(mesh);
    mesh.reserve(end_.vertices, end_.edges, end_.triangles);
    return true;
  }

  Counts end_;
};

// What a mesh takes: its items, the positions of vertices, old and new, and those of edges.
uint64_t mesh_bytes(const Counts& counts) {
  using Items = OpenMesh::ArrayItems;
  using Point = ReportingMesh::Point;
  return counts.vertices * (sizeof(Items::Vertex) + 2 * sizeof(Point)) +
         counts.edges * (sizeof(Items::Edge) + sizeof(Point)) +
         counts.triangles * sizeof(Items::Face);
}

void fill_mesh(const Scene& scene, const ManifoldCorners& corners, ReportingMesh& mesh,
               SceneWriter& writer) {
  for (const uint32_t vertex : corners.scene_vertex) {
    const float* v = &scene.vertices[size_t(3) * vertex];
    mesh.new_vertex({v[0], v[1], v[2]});
  }
  for (size_t i = 0; i < scene.indices.size(); i += 3) {
    writer.work(3);
    const uint32_t* c = &corners.vertex_of_corner[i];
    const ReportingMesh::VertexHandle triangle[] = {ReportingMesh::VertexHandle(int(c[0])),
                                                    ReportingMesh::VertexHandle(int(c[1])),
                                                    ReportingMesh::VertexHandle(int(c[2]))};
    if (!mesh.add_face(triangle, 3).is_valid()) {
      fail(SOBB_ERROR_INTERNAL, "OpenMesh refuses triangle %zu", i / 3);
    }
  }
}

// Where OpenMesh puts descendant `which` of a triangle: each subdivision leaves the middle child of
// triangle i at i, and appends the other three, of all triangles in order.
uint64_t descendant(uint64_t triangle, uint64_t which, unsigned subdivisions, uint64_t triangles) {
  for (unsigned step = subdivisions; step-- > 0; triangles *= 4) {
    const uint64_t child = which >> (2 * step) & 3;
    if (child > 0) triangle = triangles + 3 * triangle + child - 1;
  }
  return triangle;
}

void write_mesh(const Scene& scene, unsigned subdivisions, const ReportingMesh& mesh,
                SceneWriter& writer) {
  for (const ReportingMesh::VertexHandle vertex : mesh.vertices()) {
    const ReportingMesh::Point& p = mesh.point(vertex);
    writer.add_vertex(p[0], p[1], p[2], "subdivided");
  }
  const uint64_t triangles = scene.indices.size() / 3;
  for (const SceneMesh& from : scene.meshes) {
    writer.begin_mesh(from.name);
    for (uint64_t i = 0; i < from.triangle_count << (2 * subdivisions); ++i) {
      const uint64_t face =
          descendant(from.first_triangle + (i >> (2 * subdivisions)),
                     i & ((1U << (2 * subdivisions)) - 1), subdivisions, triangles);
      uint64_t polygon[3];
      ReportingMesh::HalfedgeHandle edge =
          mesh.halfedge_handle(ReportingMesh::FaceHandle(int(face)));
      for (uint64_t& corner : polygon) {
        corner = uint64_t(mesh.to_vertex_handle(edge).idx());
        edge = mesh.next_halfedge_handle(edge);
      }
      writer.add_polygon(polygon, "subdivided");
    }
  }
}

uint64_t scene_bytes(const Scene& scene) {
  return scene.vertices.capacity() * sizeof(float) + scene.indices.capacity() * sizeof(uint32_t);
}

}  // namespace

unsigned parse_subdivisions(const std::string& source, std::string_view text) {
  if (text == "4") return 1;
  if (text == "16") return 2;
  if (text == "64") return 3;
  fail(SOBB_ERROR_SCENE_SYNTAX, "%s: after '^' comes 4, 16 or 64, how many times the triangles",
       source.c_str());
}

void subdivide_scene(const std::string& source, unsigned subdivisions, uint64_t memory_limit,
                     Scene& scene, Progress* progress) {
  const uint64_t triangles = scene.indices.size() / 3;
  const auto refuse = [&] {
    fail(SOBB_ERROR_TOO_LARGE, "%s: more than 2^30 edges, from %llu triangles", source.c_str(),
         static_cast<unsigned long long>(triangles));
  };
  // There are at least as many edges as triangles.
  if (triangles << (2 * subdivisions) > kMostEdges) refuse();

  Scene refined;
  SceneWriter writer(source, memory_limit, refined, progress);
  writer.hold(scene_bytes(scene));
  const ManifoldCorners corners = find_manifold_corners(scene, writer);
  Counts counts = {corners.scene_vertex.size(), corners.edge_count, triangles};
  uint64_t work = 0;
  for (unsigned i = 0; i < subdivisions; ++i) {
    work += counts.vertices + 2 * counts.edges + 3 * counts.triangles;
    counts = counts.subdivided();
  }
  if (counts.edges > kMostEdges) refuse();
  writer.hold((corners.vertex_of_corner.capacity() + corners.scene_vertex.capacity()) *
                  sizeof(uint32_t) +
              corners.most_edges * sizeof(std::pair<float, float>) + mesh_bytes(counts));
  writer.expect(counts.vertices, counts.triangles);

  ReportingMesh mesh(writer, work);
  mesh.reserve(counts.vertices, counts.edges, counts.triangles);
  fill_mesh(scene, corners, mesh, writer);
  Loop loop(counts);
  loop.init_weights(corners.most_edges + 1);
  loop(mesh, subdivisions);
  write_mesh(scene, subdivisions, mesh, writer);
  writer.finish();
  refined.views = std::move(scene.views);
  refined.default_view = scene.default_view;
  refined.notes = std::move(scene.notes);
  scene = std::move(refined);
}

}  // namespace sobb
