// SPDX-License-Identifier: Apache-2.0
// The search over free normals finds the least area where it is known.
#include "study/areas/free_normals.h"

#include <gtest/gtest.h>

#include <array>

#include "base/memory.h"
#include "bounds/area.h"
#include "builder/topology/topology.h"
#include "support/soups.h"

namespace sobb::study {
namespace {

constexpr Normals kAxes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

// The corners of a parallelepiped as the vertices of eight triangles.
test::Soup parallelepiped(const float edge[3][3]) {
  test::Soup soup{"parallelepiped", {}, {}};
  for (int corner = 0; corner < 8; ++corner) {
    for (int k = 0; k < 3; ++k) {
      float at = 0;
      for (int i = 0; i < 3; ++i) at += (corner >> i & 1) != 0 ? edge[i][k] : 0;
      soup.vertices.push_back(at);
    }
  }
  for (uint32_t i = 0; i < 8; ++i) {
    soup.indices.insert(soup.indices.end(), {i, (i + 1) % 8, (i + 3) % 8});
  }
  return soup;
}

PointSet points_of(const test::Soup& soup) {
  const Scheduler scheduler(1, nullptr);
  Memory memory;
  Progress progress(nullptr, nullptr);
  const Mesh mesh(soup.view(), scheduler);
  const Topology topology(mesh, SOBB_QUALITY_MEDIUM, scheduler, memory, progress, 1);
  return {mesh, topology, topology.root()};
}

TEST(FreeNormals, WidthsAreThoseOfTheCorners) {
  const float edge[3][3] = {{2, 0, 0}, {0, 3, 0}, {1, 1, 4}};
  const PointSet points = points_of(parallelepiped(edge));
  EXPECT_EQ(points.size(), 8U);
  EXPECT_FLOAT_EQ(static_cast<float>(points.width({1, 0, 0})), 3);
  EXPECT_FLOAT_EQ(static_cast<float>(points.width({0, 1, 0})), 4);
  EXPECT_FLOAT_EQ(static_cast<float>(points.width({0, 0, 1})), 4);
  EXPECT_NEAR(area_with(points, kAxes), 2 * (12 + 12 + 16), 1e-4);
}

// No smaller box is known, so the search must come at least as low.
TEST(FreeNormals, FindsASkewedBox) {
  const float edge[3][3] = {{2, 0.3F, 0.1F}, {0.4F, 3, 0.2F}, {1.5F, 1.2F, 2}};
  const PointSet points = points_of(parallelepiped(edge));
  Vector edges[3];
  for (size_t i = 0; i < 3; ++i) edges[i] = {edge[i][0], edge[i][1], edge[i][2]};
  const double area = edge_area(edges);
  const std::array<Normals, 1> starts = {kAxes};
  EXPECT_GT(area_with(points, kAxes), 1.5 * area);
  EXPECT_LE(optimise_normals(points, starts), area * (1 + 1e-3));
}

TEST(FreeNormals, IsNeverAboveAStart) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const PointSet points = points_of(test::random_soup(seed, 8, 0.5));
    const std::array<Normals, 1> starts = {kAxes};
    EXPECT_LE(optimise_normals(points, starts), area_with(points, kAxes) * (1 + 1e-6));
  }
}

}  // namespace
}  // namespace sobb::study
