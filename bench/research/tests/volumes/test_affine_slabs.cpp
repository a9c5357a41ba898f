// SPDX-License-Identifier: Apache-2.0
// Three affine slabs have the area of the slabs that they were made from.
#include "volumes/affine_slabs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/soups.h"

namespace sobb::study {
namespace {

using test::Random;

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

}  // namespace
}  // namespace sobb::study
