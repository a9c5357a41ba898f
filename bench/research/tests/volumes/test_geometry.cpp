// SPDX-License-Identifier: Apache-2.0
// The geometry of the comparison's volumes: areas, and the ditetrahedron's orientation.
#include <gtest/gtest.h>

#include <cmath>

#include "support/soups.h"
#include "volumes/affine_slabs.h"
#include "volumes/ditetrahedron.h"
#include "volumes/dop_area.h"
#include "volumes/tables.h"

namespace sobb::study {
namespace {

using test::Random;

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

TEST(AffineSlabs, AreaIsThatOfTheSlabs) {
  Random random(1);
  for (int round = 0; round < 1000; ++round) {
    Direction normal[3];
    double width[3];
    AffineSlabs slabs;
    for (int j = 0; j < 3; ++j) {
      double n[3];
      double square = 0;
      for (double& x : n) {
        x = random.between(-1, 1);
        square += x * x;
      }
      const double length = std::sqrt(square);
      normal[j] = {static_cast<float>(n[0] / length), static_cast<float>(n[1] / length),
                   static_cast<float>(n[2] / length)};
      const float lower = random.between(-1, 1);
      const float upper = lower + random.between(0.01, 1);
      width[j] = static_cast<double>(upper) - lower;
      slabs.set(j, normal[j], lower, upper, /*radius=*/2);
    }
    if (std::fabs(determinant(normal[0], normal[1], normal[2])) < 0.05) continue;
    const double right = slab_area(normal, width);
    EXPECT_NEAR(slabs.area(), right, 1e-3 * right) << "seed 1, round " << round;
  }
}

// The points of a box in any orientation: the ditetrahedron finds a box as good, since two of its
// edges are edges or diagonals of faces.
TEST(Ditetrahedron, BoundsATurnedBeamClosely) {
  Random random(2);
  for (int round = 0; round < 200; ++round) {
    // A random orthonormal frame.
    double axis[3][3];
    for (auto& v : axis) {
      for (double& x : v) x = random.between(-1, 1);
    }
    const auto normalise = [](double v[3]) {
      const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
      for (int k = 0; k < 3; ++k) v[k] /= length;
    };
    normalise(axis[0]);
    const double along =
        axis[1][0] * axis[0][0] + axis[1][1] * axis[0][1] + axis[1][2] * axis[0][2];
    for (int k = 0; k < 3; ++k) axis[1][k] -= along * axis[0][k];
    normalise(axis[1]);
    for (int k = 0; k < 3; ++k) {
      axis[2][k] =
          axis[0][(k + 1) % 3] * axis[1][(k + 2) % 3] - axis[0][(k + 2) % 3] * axis[1][(k + 1) % 3];
    }
    const double half[3] = {5, 0.3, 0.1};
    std::vector<RelativePoint> corners;
    for (int corner = 0; corner < 8; ++corner) {
      double p[3] = {};
      for (int j = 0; j < 3; ++j) {
        for (int k = 0; k < 3; ++k)
          p[k] += ((corner >> j & 1) != 0 ? 1 : -1) * half[j] * axis[j][k];
      }
      corners.push_back(
          {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
    }
    const MeshSummary summary{{-5, -5, -5}, {5, 5, 5}, {0, 0, 0}, 6, 0, 0};
    const Tables tables(kMethods[2], SOBB_STRATEGY_K2, bounds_kernels(SOBB_ISA_SSE4), summary,
                        *std::pmr::get_default_resource());
    ExtremalPoints extremal;
    extremal.fit(tables, corners.data(), 4);
    ExtremalPoints rest;
    rest.fit(tables, corners.data() + 4, 4);
    extremal.merge(rest);
    Direction basis[3];
    ditetrahedron_basis(extremal, basis);
    double width[3];
    for (int j = 0; j < 3; ++j) {
      double low = 1e9;
      double high = -1e9;
      for (const RelativePoint& p : corners) {
        const double at = basis[j].x * p.x + basis[j].y * p.y + basis[j].z * p.z;
        low = std::min(low, at);
        high = std::max(high, at);
      }
      width[j] = high - low;
    }
    const double exact = 8 * (half[0] * half[1] + half[1] * half[2] + half[2] * half[0]);
    EXPECT_LE(slab_area(basis, width), 1.5 * exact) << "seed 2, round " << round;
    EXPECT_NEAR(std::fabs(determinant(basis[0], basis[1], basis[2])), 1, 1e-5);
  }
}

}  // namespace
}  // namespace sobb::study
