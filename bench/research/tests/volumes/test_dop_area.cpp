// SPDX-License-Identifier: Apache-2.0
// dop_area() measures 14-DOPs whose area is known.
#include "volumes/dop_area.h"

#include <gtest/gtest.h>

#include <cmath>

#include "volumes/tables.h"

namespace sobb::study {
namespace {

constexpr float kThird = 0.57735026F;  // 1 / sqrt 3
constexpr Method kDop14 = kMethods[1];
static_assert(kDop14.volume == VolumeKind::kDop14);

// The cuts of a box [-1, 1]^3 by planes at `cut` along the diagonals.
double cut_cube_area(float cut) {
  float slab[7][2];
  for (int k = 0; k < 7; ++k) {
    slab[k][1] = k < 3 ? 1 : cut;
    slab[k][0] = -slab[k][1];
  }
  return dop_area(directions_of(kDop14), slab);
}

TEST(DopArea, OfABoxThatNothingCuts) { EXPECT_NEAR(cut_cube_area(1.8F), 24, 1e-6); }

// A corner loses three right isosceles triangles of legs h and gains the equilateral one over their
// hypotenuses, h = sqrt(3) (sqrt(3) - cut).
TEST(DopArea, OfABoxWithItsCornersCut) {
  const double cut = 1.4;
  const double h = std::sqrt(3.0) * (std::sqrt(3.0) - cut);
  EXPECT_NEAR(cut_cube_area(1.4F), 24 + 8 * (std::sqrt(3.0) / 2 - 1.5) * h * h, 1e-4);
}

// Cut down to the octahedron of vertices at distance 1: eight triangles of side sqrt(2).
TEST(DopArea, OfAnOctahedron) {
  EXPECT_NEAR(cut_cube_area(kThird), 8 * std::sqrt(3.0) / 4 * 2, 1e-4);
}

TEST(DopArea, OfAPoint) {
  const float slab[7][2] = {};
  EXPECT_EQ(dop_area(directions_of(kDop14), slab), 0);
}

}  // namespace
}  // namespace sobb::study
