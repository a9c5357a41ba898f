// SPDX-License-Identifier: Apache-2.0
// Both forms of a skewed box's area agree, and equal known values.
#include <gtest/gtest.h>

#include <cmath>

#include "bounds/area.h"
#include "support/soups.h"

namespace sobb::test {
namespace {

constexpr Direction kX = {1, 0, 0};
constexpr Direction kY = {0, 1, 0};
constexpr Direction kZ = {0, 0, 1};

double edge_form(const Direction normal[3], const double width[3]) {
  Vector edge[3];
  slab_edges(normal, width, edge);
  return edge_area(edge);
}

Direction random_direction(Random& random) {
  double at[3];
  double square;
  do {
    for (double& value : at) value = 2 * random.uniform() - 1;
    square = at[0] * at[0] + at[1] * at[1] + at[2] * at[2];
  } while (square > 1 || square < 0.01);
  const double length = std::sqrt(square);
  return {static_cast<float>(at[0] / length), static_cast<float>(at[1] / length),
          static_cast<float>(at[2] / length)};
}

TEST(Area, OfTheAxesIsTheAabbs) {
  const Direction axes[3] = {kX, kY, kZ};
  const double width[3] = {1, 2, 3};
  EXPECT_DOUBLE_EQ(slab_area(axes, width), 22);
  EXPECT_DOUBLE_EQ(edge_form(axes, width), 22);
}

TEST(Area, OfASkewedBoxCountedByHand) {
  // The box |x|, |y|, |x + z| <= 1/2 has two faces each of area 1, 1 and sqrt 2.
  const auto half = static_cast<float>(std::sqrt(0.5));
  const Direction normal[3] = {kX, kY, {half, 0, half}};
  const double width[3] = {1, 1, half};
  EXPECT_NEAR(slab_area(normal, width), 4 + 2 * std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(edge_form(normal, width), 4 + 2 * std::sqrt(2.0), 1e-6);
}

TEST(Area, OfAFlatBoxIsItsTwoSides) {
  const Direction axes[3] = {kX, kY, kZ};
  const double width[3] = {0, 2, 3};
  EXPECT_DOUBLE_EQ(slab_area(axes, width), 12);
  EXPECT_DOUBLE_EQ(edge_form(axes, width), 12);
  const double line[3] = {0, 0, 3};
  EXPECT_EQ(slab_area(axes, line), 0);
  EXPECT_EQ(edge_form(axes, line), 0);
}

TEST(Area, FormsAgreeOnRandomSkewedBoxes) {
  constexpr uint64_t kSeed = 71;
  Random random(kSeed);
  for (int round = 0; round < 20'000; ++round) {
    Direction normal[3];
    double width[3];
    do {
      for (Direction& n : normal) n = random_direction(random);
    } while (std::fabs(determinant(normal[0], normal[1], normal[2])) < 0.01);
    for (double& d : width) d = std::exp(20 * random.uniform() - 10);
    // The slab form takes normals to have length 1 exactly, the edge form does not.
    const double slab = slab_area(normal, width);
    ASSERT_NEAR(edge_form(normal, width) / slab, 1, 1e-6) << "seed " << kSeed << " round " << round;
  }
}

TEST(Area, EdgesCrossTheirSlabAndLieInTheOthers) {
  constexpr uint64_t kSeed = 72;
  Random random(kSeed);
  for (int round = 0; round < 1000; ++round) {
    Direction normal[3];
    for (Direction& n : normal) n = random_direction(random);
    if (std::fabs(determinant(normal[0], normal[1], normal[2])) < 0.01) continue;
    const double width[3] = {1, 2, 3};
    Vector edge[3];
    slab_edges(normal, width, edge);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const double along =
            normal[j].x * edge[i][0] + normal[j].y * edge[i][1] + normal[j].z * edge[i][2];
        ASSERT_NEAR(along, i == j ? width[i] : 0, 1e-9)
            << "seed " << kSeed << " round " << round << " edge " << i << " slab " << j;
      }
    }
  }
}

}  // namespace
}  // namespace sobb::test
