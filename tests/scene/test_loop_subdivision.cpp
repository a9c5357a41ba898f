// SPDX-License-Identifier: Apache-2.0
// Refined scenes: Loop's masks by hand, every triangle kept, meshes and views, suffixes and errors.
#include "scene/subdivision/loop_subdivision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "scene/load_testing.h"
#include "scene/model/scene_writer.h"
#include "support/closed_meshes.h"
#include "support/soups.h"

namespace sobb {
namespace {

using test::Random;
using Point = std::array<float, 3>;

Scene make_scene(const std::vector<float>& vertices, const std::vector<uint32_t>& indices) {
  Scene scene;
  SceneWriter writer("made", 0, scene);
  for (size_t i = 0; i < vertices.size(); i += 3) {
    writer.add_vertex(vertices[i], vertices[i + 1], vertices[i + 2], "made");
  }
  for (size_t i = 0; i < indices.size(); i += 3) {
    writer.add_polygon(std::array<uint64_t, 3>{indices[i], indices[i + 1], indices[i + 2]}, "made");
  }
  writer.finish();
  return scene;
}

Scene subdivided(Scene scene, unsigned subdivisions) {
  subdivide_scene("made", subdivisions, 0, scene, nullptr);
  return scene;
}

Point corner(const Scene& scene, size_t triangle, size_t which) {
  const float* v = &scene.vertices[size_t(3) * scene.indices[3 * triangle + which]];
  return {v[0], v[1], v[2]};
}

std::set<Point> places(const Scene& scene, size_t first_triangle, size_t triangles) {
  std::set<Point> result;
  for (size_t i = 3 * first_triangle; i < 3 * (first_triangle + triangles); ++i) {
    result.insert(corner(scene, i / 3, i % 3));
  }
  return result;
}

// How many edges have not exactly one neighbour, which runs the other way.
size_t loose_edges(const Scene& scene) {
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  for (size_t i = 0; i < scene.indices.size(); i += 3) {
    for (size_t k = 0; k < 3; ++k) {
      edges.emplace_back(scene.indices[i + k], scene.indices[i + (k + 1) % 3]);
    }
  }
  std::ranges::sort(edges);
  const auto count = [&](uint32_t from, uint32_t to) {
    const auto [begin, end] = std::equal_range(edges.begin(), edges.end(), std::pair(from, to));
    return end - begin;
  };
  return size_t(std::ranges::count_if(edges, [&](const auto& edge) {
    return count(edge.first, edge.second) != 1 || count(edge.second, edge.first) != 1;
  }));
}

const std::vector<float> kOctahedron = {8, 0, 0, -8, 0, 0, 0, 8, 0, 0, -8, 0, 0, 0, 8, 0, 0, -8};
const std::vector<uint32_t> kOctahedronFaces = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4,
                                                2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};

// An edge's mask is 3/8 3/8 1/8 1/8. A vertex with n neighbours gives each the weight
// (40 - (3 + 2 cos(2 pi / n))^2) / (64 n): 31/256 where n = 4, 3/16 where n = 3.
TEST(LoopSubdivision, FollowsTheMasks) {
  const Scene octahedron = subdivided(make_scene(kOctahedron, kOctahedronFaces), 1);
  EXPECT_EQ(octahedron.indices.size() / 3, 32U);
  EXPECT_EQ(octahedron.vertices.size() / 3, 18U);
  const float v = 8 * 33.0F / 64;
  const std::set<Point> children = {{v, 0, 0}, {0, v, 0}, {0, 0, v},
                                    {3, 3, 0}, {0, 3, 3}, {3, 0, 3}};
  EXPECT_EQ(places(octahedron, 0, 4), children);
  EXPECT_EQ(places(octahedron, 0, 1), (std::set<Point>{{3, 3, 0}, {0, 3, 3}, {3, 0, 3}}));

  const Scene tetrahedron = subdivided(
      make_scene({8, 8, 8, 8, -8, -8, -8, 8, -8, -8, -8, 8}, {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2}),
      1);
  EXPECT_EQ(places(tetrahedron, 0, 16), (std::set<Point>{{2, 2, 2},
                                                         {2, -2, -2},
                                                         {-2, 2, -2},
                                                         {-2, -2, 2},
                                                         {4, 0, 0},
                                                         {-4, 0, 0},
                                                         {0, 4, 0},
                                                         {0, -4, 0},
                                                         {0, 0, 4},
                                                         {0, 0, -4}}));
}

// Where a surface ends it is a cubic B-spline: 1/8 6/8 1/8, and the middle of each edge.
TEST(LoopSubdivision, SmoothsEndsAsCurves) {
  const Scene one = subdivided(make_scene({0, 0, 0, 8, 0, 0, 0, 8, 0}, {0, 1, 2}), 1);
  EXPECT_EQ(places(one, 0, 4),
            (std::set<Point>{{1, 1, 0}, {6, 1, 0}, {1, 6, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}));
  EXPECT_EQ(places(one, 0, 1), (std::set<Point>{{4, 0, 0}, {4, 4, 0}, {0, 4, 0}}));
}

TEST(LoopSubdivision, KeepsClosedMeshesClosedAndFacing) {
  int closed = 0;
  for (const test::ClosedMesh& mesh : test::closed_meshes()) {
    SCOPED_TRACE(mesh.soup.name);
    const Scene scene = make_scene(mesh.soup.vertices, mesh.soup.indices);
    if (loose_edges(scene) > 0) continue;  // sides that face opposite ways
    ++closed;
    const Scene refined = subdivided(scene, 2);
    EXPECT_EQ(refined.indices.size(), 16 * scene.indices.size());
    EXPECT_EQ(loose_edges(refined), 0U);
    EXPECT_EQ(refined.vertices.size() / 3, 2 + refined.indices.size() / 6);  // Euler: a sphere
  }
  EXPECT_GE(closed, 4);
}

// In the limit an octahedron's vertex p goes to p + c (m - p), with c = 1 / (1 + 3 / (8 * 31/64))
// and m the mean of its four neighbours, which is the centre 0.
TEST(LoopSubdivision, ConvergesToTheLimit) {
  const double limit = 8 - 8 / (1 + 3 / (8 * 31.0 / 64));
  const Scene scene = make_scene(kOctahedron, kOctahedronFaces);
  double before = 8;
  for (const unsigned subdivisions : {1, 2, 3}) {
    const Scene refined = subdivided(scene, subdivisions);
    const double distance = std::fabs(refined.bounds_max[0] - limit);
    EXPECT_LT(distance, before / 2);
    before = distance;
  }
}

TEST(LoopSubdivision, WeldsVerticesAtOnePlace) {
  const std::vector<float> square = {0,    0, 0, 8, 0, 0, 8, 8, 0,  //
                                     -0.F, 0, 0, 8, 8, 0, 0, 8, -0.F};
  const Scene refined = subdivided(make_scene(square, {0, 1, 2, 3, 4, 5}), 1);
  EXPECT_EQ(refined.vertices.size() / 3, 9U);
  EXPECT_TRUE(places(refined, 0, 8).contains({4, 4, 0}));
}

// The meshes are two tetrahedra that touch at a corner, three triangles at an edge, neighbours that
// face opposite ways, a triangle and its back, the same triangle twice, a strip with one half turn,
// and degenerate triangles.
TEST(LoopSubdivision, LosesNothingWhereSurfacesAreNoManifold) {
  const std::vector<float> points = {0, 0,  0, 8, 0, 0,  0, 8, 0, 0, 0,
                                     8, -8, 0, 0, 0, -8, 0, 0, 0, -8};
  const std::vector<std::vector<uint32_t>> meshes = {
      {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2, 0, 5, 4, 0, 4, 6, 0, 6, 5, 4, 5, 6},
      {0, 1, 2, 1, 0, 3, 0, 1, 5},
      {0, 1, 2, 0, 1, 3},
      {0, 1, 2, 0, 2, 1},
      {0, 1, 2, 0, 1, 2},
      {0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5, 4, 5, 0, 0, 5, 1},
      {0, 0, 1, 0, 0, 0, 0, 1, 2}};
  for (const std::vector<uint32_t>& indices : meshes) {
    const Scene scene = make_scene(points, indices);
    for (const unsigned subdivisions : {1, 2, 3}) {
      const Scene refined = subdivided(scene, subdivisions);
      EXPECT_EQ(refined.indices.size(), scene.indices.size() << (2 * subdivisions));
      EXPECT_GE(refined.degenerate_count, scene.degenerate_count << (2 * subdivisions));
    }
  }
  // Each of the three surfaces ends at the edge, along the same curve.
  const Scene three = subdivided(make_scene(points, meshes[1]), 1);
  for (const size_t first : {0, 4, 8}) EXPECT_TRUE(places(three, first, 4).contains({4, 0, 0}));
}

TEST(LoopSubdivision, KeepsEveryTriangleOfSoups) {
  const uint64_t seed = 20'261'123;
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int i = 0; i < 300; ++i) {
    const uint32_t side = 2 + random.below(3);
    std::vector<float> vertices;
    std::vector<uint32_t> indices;
    for (uint32_t v = 0; v < 30; ++v) {
      for (int k = 0; k < 3; ++k) vertices.push_back(float(random.below(side)));
    }
    for (uint32_t t = 3 * (1 + random.below(60)); t > 0; --t) indices.push_back(random.below(30));
    const Scene scene = make_scene(vertices, indices);
    const unsigned subdivisions = 1 + random.below(2);
    const Scene refined = subdivided(scene, subdivisions);
    ASSERT_EQ(refined.indices.size(), scene.indices.size() << (2 * subdivisions));
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(refined.bounds_min[k], scene.bounds_min[k]);
      EXPECT_LE(refined.bounds_max[k], scene.bounds_max[k]);
    }
  }
}

// Weights are rounded to float, so that the last bits of a machine's cosine do not matter.
TEST(LoopSubdivision, WeightsAreFarFromTies) {
  for (int n = 1; n <= 10'000; ++n) {
    const double t = 3 + 2 * std::cos(2 * M_PI / n);
    const double alpha = (40 - t * t) / 64;
    for (const double weight : {1 - alpha, alpha / n}) {
      EXPECT_EQ(float(weight * (1 + 0x1p-50)), float(weight * (1 - 0x1p-50))) << n;
    }
  }
}

TEST(LoopSubdivision, TakesManyTrianglesAboutAVertex) {
  std::vector<float> vertices = {0, 0, 9};
  std::vector<uint32_t> indices;
  const uint32_t count = 3000;
  for (uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * M_PI * i / count;
    vertices.insert(vertices.end(), {float(std::cos(angle)), float(std::sin(angle)), 0});
    indices.insert(indices.end(), {0, 1 + i, 1 + (i + 1) % count});
  }
  const Scene refined = subdivided(make_scene(vertices, indices), 1);
  EXPECT_EQ(refined.indices.size(), size_t(12) * count);
  EXPECT_NEAR(refined.bounds_max[2], 9 * (1 - 15.0 / 64), 1e-4);
}

class SubdividedFiles : public test::LoadingFiles {
 protected:
  std::string obj_ =
      write("two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\ng a\nf 1 2 3\ng b\nf 1 2 4\nf 2 3 4\n");
};

TEST_F(SubdividedFiles, KeepTheOrderOfMeshesAndTheViews) {
  const Scene plain = load(obj_);
  const Scene refined = load(obj_ + "^16");
  ASSERT_EQ(refined.meshes.size(), 2U);
  EXPECT_EQ(refined.meshes[0].name, "a");
  EXPECT_EQ(refined.meshes[0].triangle_count, 16U);
  EXPECT_EQ(refined.meshes[1].first_triangle, 16U);
  EXPECT_EQ(refined.meshes[1].triangle_count, 32U);
  ASSERT_EQ(refined.views.size(), 1U);
  EXPECT_TRUE(refined.default_view);
  EXPECT_EQ(refined.views[0].eye[0], plain.views[0].eye[0]);
}

TEST_F(SubdividedFiles, TurnAsTheFilesDo) {
  const Scene straight = load(obj_ + "^4");
  const Scene turned = load(obj_ + "^4@30");
  const Scene only_turned = load(obj_ + "@30");
  EXPECT_EQ(straight.indices, turned.indices);
  EXPECT_NE(straight.vertices, turned.vertices);
  EXPECT_EQ(only_turned.views[0].eye[1], turned.views[0].eye[1]);
  EXPECT_EQ(load("builtin:terrain:500^64@30").indices.size(),
            64 * load("builtin:terrain:500@30").indices.size());
}

TEST_F(SubdividedFiles, HaveTimesBehindThePath) {
  const std::string whole = write("a^4.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(load(whole).indices.size(), 3U);
  EXPECT_EQ(load(whole + "^4").indices.size(), 12U);
  for (const std::string suffix :
       {"^", "^5", "^x", "^016", "^16 ", "^-4", "^", "^64.0", "^4@30^4"}) {
    const bool turn = suffix == "^4@30^4";
    const std::string expected = turn ? "after '@' comes" : "after '^' comes 4, 16 or 64";
    expect_error(obj_ + suffix, SOBB_ERROR_SCENE_SYNTAX, expected);
    expect_error("builtin:city:1000" + suffix, SOBB_ERROR_SCENE_SYNTAX, expected);
  }
  expect_error(obj_ + "^5@30", SOBB_ERROR_SCENE_SYNTAX, "two.obj^5@30: after '^'");
  expect_error(obj_ + "^4^4", SOBB_ERROR_SCENE_FORMAT, "unknown ending 'obj^4'");
  expect_error("builtin:city^4:1000", SOBB_ERROR_SCENE_SYNTAX, "after '^'");
  write("b^4", "no scene");
  expect_error(path("b^4"), SOBB_ERROR_SCENE_FORMAT, "unknown ending");
}

TEST_F(SubdividedFiles, KeepTheMemoryLimit) {
  const std::string source = "builtin:city:5000";
  expect_error(source + "^64", SOBB_ERROR_MEMORY_LIMIT, source + "^64: needs", nullptr, 10'000'000);
  EXPECT_EQ(load_scene(source, nullptr, 10'000'000).indices.size() * 16,
            load_scene(source + "^16", nullptr, 20'000'000).indices.size());
}

TEST(LoopSubdivision, RefusesMoreThanOpenMeshCounts) {
  const Scene scene = make_scene(kOctahedron, kOctahedronFaces);
  Scene many = scene;
  many.indices.resize(size_t(3) * ((1U << 24) + 1));
  test::expect_failure(SOBB_ERROR_TOO_LARGE, "made^64",
                       [&] { subdivide_scene("made^64", 3, 0, many, nullptr); });
}

}  // namespace
}  // namespace sobb
