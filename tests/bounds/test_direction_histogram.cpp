// SPDX-License-Identifier: Apache-2.0
// A histogram finds the peaks of directions, and their principal axes.
#include <gtest/gtest.h>

#include <cmath>
#include <memory_resource>
#include <string>

#include "bounds/directions/direction_histogram.h"
#include "support/soups.h"

namespace sobb::test {
namespace {

Vector random_direction(Random& random) {
  for (;;) {
    const Vector v = {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    const double norm = length(v);
    if (norm > 0.1 && norm < 1) return {v[0] / norm, v[1] / norm, v[2] / norm};
  }
}

DirectionHistogram empty() { return DirectionHistogram(*std::pmr::get_default_resource()); }

TEST(DirectionHistogram, FindsADirectionAndItsOpposite) {
  constexpr uint64_t kSeed = 1;
  Random random(kSeed);
  for (int round = 0; round < 300; ++round) {
    Vector peak = random_direction(random);
    if (round % 3 == 0) peak[static_cast<size_t>(round / 3 % 3)] = 0;  // where the square is cut
    const double norm = length(peak);
    for (double& component : peak) component /= norm;
    DirectionHistogram histogram = empty();
    for (int i = 0; i < 50; ++i) {
      const double factor = (i % 2 == 0 ? 1 : -1) * (1 + random.uniform());
      Vector v;
      for (size_t k = 0; k < 3; ++k) v[k] = factor * (peak[k] + random.between(-1e-4, 1e-4));
      histogram.add(v);
    }
    const auto peaks = histogram.peaks(4, 0.1);
    ASSERT_EQ(peaks.size(), 1u) << "seed " << kSeed << " round " << round;
    EXPECT_GT(std::fabs(dot(peaks[0].direction, peak)), 1 - 1e-7) << round;
    EXPECT_NEAR(length(peaks[0].direction), 1, 1e-12);
    EXPECT_NEAR(peaks[0].share, 1, 1e-12);
  }
}

TEST(DirectionHistogram, OrdersPeaksByWeight) {
  DirectionHistogram histogram = empty();
  histogram.add({0, 0, 2});
  histogram.add({3, 0, 0});
  histogram.add({-1, 0, 1e-9});
  DirectionHistogram other = empty();
  other.add({0, -4, 3});
  histogram.add(other);
  const auto peaks = histogram.peaks(8, 0.01);
  ASSERT_EQ(peaks.size(), 3u);
  EXPECT_NEAR(std::fabs(peaks[0].direction[1]), 0.8, 1e-12);
  EXPECT_NEAR(std::fabs(peaks[1].direction[0]), 1, 1e-9);
  EXPECT_NEAR(peaks[1].share, 4.0 / 11, 1e-9);
  EXPECT_NEAR(std::fabs(peaks[2].direction[2]), 1, 1e-12);
  EXPECT_EQ(histogram.peaks(2, 0.01).size(), 2u);
  EXPECT_EQ(histogram.peaks(8, 0.3).size(), 2u);
}

TEST(DirectionHistogram, HasNoPeaksOfEvenDirections) {
  Random random(2);
  DirectionHistogram histogram = empty();
  EXPECT_TRUE(histogram.peaks(8, 0.01).empty());
  histogram.add({0, 0, 0});
  EXPECT_TRUE(histogram.peaks(8, 0.01).empty());
  for (int i = 0; i < 50'000; ++i) histogram.add(random_direction(random));
  EXPECT_TRUE(histogram.peaks(8, 0.01).empty());
}

TEST(PrincipalAxes, AreEigenvectors) {
  constexpr uint64_t kSeed = 3;
  Random random(kSeed);
  for (int round = 0; round < 500; ++round) {
    Vector matrix[3] = {};
    for (int i = 0; i < (round % 2 == 0 ? 1 : 5); ++i) {
      const Vector v = random_direction(random);
      for (size_t p = 0; p < 3; ++p) {
        for (size_t q = 0; q < 3; ++q) matrix[p][q] += v[p] * v[q];
      }
    }
    const OrthogonalFrame frame = principal_axes(matrix);
    for (const Vector& axis : frame.axis) {
      const Vector image = {dot(matrix[0], axis), dot(matrix[1], axis), dot(matrix[2], axis)};
      EXPECT_LT(length(cross(image, axis)), 1e-12) << "seed " << kSeed << " round " << round;
      EXPECT_NEAR(length(axis), 1, 1e-12);
    }
    EXPECT_NEAR(dot(frame.axis[0], frame.axis[1]), 0, 1e-12);
    EXPECT_NEAR(dot(frame.axis[0], frame.axis[2]), 0, 1e-12);
    EXPECT_NEAR(dot(frame.axis[1], frame.axis[2]), 0, 1e-12);
  }
}

}  // namespace
}  // namespace sobb::test
