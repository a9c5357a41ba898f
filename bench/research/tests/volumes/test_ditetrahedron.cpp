// SPDX-License-Identifier: Apache-2.0
// The ditetrahedron finds the orientation of a thin box.
#include "volumes/ditetrahedron.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bounds/area.h"
#include "support/soups.h"

namespace sobb::study {
namespace {

using test::Random;

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
