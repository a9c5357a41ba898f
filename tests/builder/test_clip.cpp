// SPDX-License-Identifier: Apache-2.0
// The parts of a cut triangle cover it, whatever is cut off and however the triangle lies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <string>

#include "builder/boxes/clip.h"
#include "builder/sampled_triangle.h"
#include "support/soups.h"

namespace sobb::test {
namespace {

bool holds(const Box& box, const Sample& p) {
  for (int k = 0; k < 3; ++k) {
    if (p.at[k] < box.lower[k] || p.at[k] > box.upper[k]) return false;
  }
  return true;
}

bool inside_out(const Box& box) {
  return box.lower[0] > box.upper[0] || box.lower[1] > box.upper[1] || box.lower[2] > box.upper[2];
}

bool within(const Box& part, const Box& whole) {
  for (int k = 0; k < 3; ++k) {
    if (part.lower[k] < whole.lower[k] || part.upper[k] > whole.upper[k]) return false;
  }
  return true;
}

// Makes a triangle of random kind, size and place: any, a sliver, flat along an axis, a line, a
// point.
Mesh random_triangle(Random& random, Soup& soup) {
  const uint32_t kind = random.below(6);
  const double size = std::pow(10.0, random.between(-12, 12));
  const double offset = random.below(3) == 0 ? 100 * size : 0;
  float corner[3][3];
  for (auto& c : corner) {
    for (float& value : c) value = static_cast<float>(offset + size * random.uniform());
  }
  for (int k = 0; k < 3; ++k) {
    if (kind == 1) corner[2][k] = static_cast<float>(corner[1][k] + 1e-6 * size * random.uniform());
    if (kind == 2 && k == 1) corner[1][k] = corner[2][k] = corner[0][k];
    if (kind == 3) corner[2][k] = corner[1][k];
    if (kind == 4) corner[1][k] = corner[2][k] = corner[0][k];
  }
  soup = {"triangle", {}, {}};
  soup.add(corner[0], corner[1], corner[2]);
  return {soup.view(), Scheduler(1, nullptr)};
}

// Expects that along no direction a sample stands out of the polygon by more than the rounding of
// its vertices.
void expect_covers(const double polygon[9][3], int count, const Sample& p,
                   const std::string& what) {
  static constexpr double kDirections[][3] = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},  {1, 1, 1},
                                              {1, -1, 0}, {0, 1, -1}, {-1, 0, 1}, {1, 1, -1},
                                              {3, -2, 5}, {-7, 4, 1}};
  for (const auto& n : kDirections) {
    double least = DBL_MAX;
    double most = -DBL_MAX;
    double largest = 0;
    for (int i = 0; i < count; ++i) {
      const double value = n[0] * polygon[i][0] + n[1] * polygon[i][1] + n[2] * polygon[i][2];
      least = std::min(least, value);
      most = std::max(most, value);
      for (int k = 0; k < 3; ++k) largest = std::max(largest, std::fabs(n[k] * polygon[i][k]));
    }
    const auto value = static_cast<double>(n[0] * p.at[0] + n[1] * p.at[1] + n[2] * p.at[2]);
    ASSERT_GE(value, least - 0x1p-48 * largest) << what;
    ASSERT_LE(value, most + 0x1p-48 * largest) << what;
  }
}

float random_plane(Random& random, const Corners& corners, const Box& box, int axis) {
  if (random.below(4) == 0) {
    const float at = corners.at[random.below(3)][axis];
    if (at >= box.lower[axis] && at <= box.upper[axis]) return at;
  }
  const float plane = random.between(box.lower[axis], box.upper[axis]);
  return std::clamp(plane, box.lower[axis], box.upper[axis]);
}

TEST(Clip, PartsCoverTheTriangle) {
  constexpr uint64_t kSeed = 101;
  Random random(kSeed);
  for (int round = 0; round < 4000; ++round) {
    Soup soup;
    const Mesh mesh = random_triangle(random, soup);
    const Corners corners(mesh, 0);
    std::vector<Sample> samples = sample_triangle(corners);
    Box box = corners.box();
    // Each step goes on with one of the parts, as spatial splits of splits do, and its samples.
    for (int depth = 0; depth < 8; ++depth) {
      const std::string what = "seed " + std::to_string(kSeed) + " round " + std::to_string(round) +
                               " depth " + std::to_string(depth);
      const int axis = static_cast<int>(random.below(3));
      const float plane = random_plane(random, corners, box, axis);
      Box below;
      Box above;
      split_box(corners, box, axis, plane, below, above);
      ASSERT_TRUE(within(below, box) && within(above, box)) << what;
      ASSERT_FALSE(inside_out(below) || inside_out(above)) << what;
      ASSERT_LE(below.upper[axis], plane) << what;
      ASSERT_GE(above.lower[axis], plane) << what;
      for (const Sample& p : samples) {
        ASSERT_TRUE(p.at[axis] > plane || holds(below, p)) << what;
        ASSERT_TRUE(p.at[axis] < plane || holds(above, p)) << what;
      }
      box = random.below(2) == 0 ? below : above;
      std::erase_if(samples, [&](const Sample& p) { return !holds(box, p); });

      double polygon[9][3];
      const int count = clip_to_box(corners, box, polygon);
      ASSERT_LE(count, 9) << what;
      ASSERT_TRUE(count > 0 || samples.empty()) << what;
      for (const Sample& p : samples) expect_covers(polygon, count, p, what);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Clip, PlanesThroughVerticesMakeNoSlivers) {
  const Soup soup{"triangle", {0, 0, 0, 2, 0, 0, 1, 2, 0}, {0, 1, 2}};
  const Mesh mesh(soup.view(), Scheduler(1, nullptr));
  const Corners corners(mesh, 0);
  Box below;
  Box above;
  split_box(corners, corners.box(), 0, 1, below, above);
  EXPECT_EQ(below, (Box{{0, 0, 0}, {1, 2, 0}}));
  EXPECT_EQ(above, (Box{{1, 0, 0}, {2, 2, 0}}));
  split_box(corners, corners.box(), 0, 0, below, above);
  EXPECT_EQ(below.upper[0], 0);
  EXPECT_LT(below.upper[1], 1e-12);
  EXPECT_EQ(above, corners.box());
}

TEST(Clip, AnUncutTriangleIsItself) {
  const Soup soup = random_soup(102, 1);
  const Mesh mesh(soup.view(), Scheduler(1, nullptr));
  const Corners corners(mesh, 0);
  double polygon[9][3];
  ASSERT_EQ(clip_to_box(corners, corners.box(), polygon), 3);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) EXPECT_EQ(polygon[i][k], corners.at[i][k]);
  }
}

TEST(Clip, ABoxThatTheTriangleMissesHasNoPolygon) {
  const Soup soup{"triangle", {0, 0, 0, 1, 0, 1, 0, 1, 1}, {0, 1, 2}};  // z = x + y
  const Mesh mesh(soup.view(), Scheduler(1, nullptr));
  double polygon[9][3];
  EXPECT_EQ(clip_to_box(Corners(mesh, 0), {{0.3F, 0.5F, 0.5F}, {0.5F, 0.7F, 0.7F}}, polygon), 0);
}

}  // namespace
}  // namespace sobb::test
