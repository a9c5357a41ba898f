// SPDX-License-Identifier: Apache-2.0
// fit() makes slabs that hold every point in exact arithmetic, are no wider than stated, and have
// the same bits on every instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "bounds/bounds_kernels.h"
#include "bounds/same_bits.h"
#include "support/soups.h"
#include "support/supported_isas.h"

namespace sobb::test {
namespace {

// A type of 113 bits, in which n . (p - c) of floats is exact if exponents differ by less than
// about 60.
__extension__ using Exact = __float128;

constexpr double kUnit = 0x1p-24;

struct Point {
  float at[3];
};

struct Cloud {
  float centre[3];
  std::vector<Point> points;

  RelativePoint relative(const Point& p) const {
    const auto along = [&](int k) {
      return static_cast<float>(static_cast<double>(p.at[k]) - centre[k]);
    };
    return {along(0), along(1), along(2)};
  }
};

// Points of some size about a centre; or all of them on one plane, line or point.
Cloud random_cloud(Random& random, double size, double distance) {
  Cloud cloud;
  for (float& c : cloud.centre) c = random.between(-distance, distance);
  const uint32_t flat = random.below(4);
  for (uint32_t i = 1 + random.below(40); i > 0; --i) {
    Point point;
    for (uint32_t k = 0; k < 3; ++k) {
      const double offset = k < flat ? size / 3 : size * (2 * random.uniform() - 1);
      point.at[k] = static_cast<float>(cloud.centre[k] + offset);
    }
    cloud.points.push_back(point);
  }
  return cloud;
}

Kdop fit(const Cloud& cloud, const DirectionTable& table, sobb_isa isa) {
  std::vector<RelativePoint> relative;
  for (const Point& point : cloud.points) relative.push_back(cloud.relative(point));
  Kdop kdop;
  std::memset(&kdop, 0xFF, sizeof kdop);
  bounds_kernels(isa).fit(table, relative.data(), relative.size(), kdop);
  return kdop;
}

Exact along(const DirectionTable& table, uint32_t k, const Cloud& cloud, const Point& point) {
  const auto difference = [&](int axis) { return Exact(point.at[axis]) - cloud.centre[axis]; };
  return Exact(table.x[k]) * difference(0) + Exact(table.y[k]) * difference(1) +
         Exact(table.z[k]) * difference(2);
}

// Twice the slack that the header states, for the rounding of the measurement here.
double allowed_slack(const DirectionTable& table, uint32_t k, const Cloud& cloud) {
  double largest[3] = {};
  for (const Point& point : cloud.points) {
    for (int axis = 0; axis < 3; ++axis) {
      largest[axis] = std::max(largest[axis],
                               std::fabs(static_cast<double>(point.at[axis]) - cloud.centre[axis]));
    }
  }
  const double reach = std::fabs(table.x[k]) * largest[0] + std::fabs(table.y[k]) * largest[1] +
                       std::fabs(table.z[k]) * largest[2];
  return 12 * kUnit * reach + 0x1p-139;
}

void check(const Cloud& cloud, const DirectionTable& table, const std::string& what) {
  const Kdop kdop = fit(cloud, table, SOBB_ISA_SSE4);
  for (const sobb_isa isa : supported_isas()) {
    const Kdop other = fit(cloud, table, isa);
    ASSERT_TRUE(same_bits(kdop.lower, other.lower) && same_bits(kdop.upper, other.upper))
        << what << " isa " << isa;
  }
  for (uint32_t k = 0; k < table.count; ++k) {
    Exact least = along(table, k, cloud, cloud.points[0]);
    Exact most = least;
    for (const Point& point : cloud.points) {
      const Exact value = along(table, k, cloud, point);
      least = std::min(least, value);
      most = std::max(most, value);
    }
    ASSERT_TRUE(kdop.lower[k] <= least && kdop.upper[k] >= most)
        << what << " direction " << k << ": [" << kdop.lower[k] << ", " << kdop.upper[k]
        << "] does not hold [" << static_cast<double>(least) << ", " << static_cast<double>(most)
        << "]";
    const double slack = allowed_slack(table, k, cloud);
    ASSERT_LE(static_cast<double>(least - kdop.lower[k]), slack) << what << " direction " << k;
    ASSERT_LE(static_cast<double>(kdop.upper[k] - most), slack) << what << " direction " << k;
  }
  for (uint32_t k = table.count; k < kMaxDirections; ++k) {
    ASSERT_EQ(std::bit_cast<uint32_t>(kdop.lower[k]) | std::bit_cast<uint32_t>(kdop.upper[k]), 0u)
        << what << " padding " << k;
  }
}

TEST(Kdop, HoldsItsPointsTightlyAtEveryScale) {
  constexpr uint64_t kSeed = 81;
  Random random(kSeed);
  for (const uint32_t k : {6U, 32U, 48U, 64U}) {
    const DirectionTable table = make_direction_table(default_directions(k));
    for (int exponent = -20; exponent <= 17; ++exponent) {
      const double size = std::pow(10.0, exponent);
      for (const double distance : {0.0, size, 1e3 * size, 1e7 * size}) {
        for (int round = 0; round < 4; ++round) {
          check(random_cloud(random, size, distance), table,
                "seed " + std::to_string(kSeed) + " k " + std::to_string(k) + " size 1e" +
                    std::to_string(exponent) + " distance " + std::to_string(distance));
          if (HasFatalFailure()) return;
        }
      }
    }
  }
}

TEST(Kdop, HoldsPointsWhoseProductsUnderflow) {
  constexpr uint64_t kSeed = 82;
  Random random(kSeed);
  const DirectionTable table = make_direction_table(default_directions(64));
  for (const double size : {1e-36, 1e-38, 1e-40, 1e-43, 1e-45}) {
    for (int round = 0; round < 20; ++round) {
      check(random_cloud(random, size, 0), table,
            "seed " + std::to_string(kSeed) + " size " + std::to_string(size));
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Kdop, OfAPartialVectorOfDirections) {
  Random random(83);
  const auto directions = default_directions(64);
  for (uint32_t count = 1; count <= kMaxDirections; ++count) {
    check(random_cloud(random, 1, 1), make_direction_table(directions.first(count)),
          "directions " + std::to_string(count));
    if (HasFatalFailure()) return;
  }
}

TEST(Kdop, MergeIsTheUnion) {
  Random random(84);
  const DirectionTable table = make_direction_table(default_directions(64));
  Cloud both = random_cloud(random, 1, 0);
  Cloud other = random_cloud(random, 2, 0);
  std::copy(both.centre, both.centre + 3, other.centre);
  Kdop merged = fit(both, table, SOBB_ISA_SSE4);
  merged.merge(fit(other, table, SOBB_ISA_SSE4));
  both.points.insert(both.points.end(), other.points.begin(), other.points.end());
  for (uint32_t k = 0; k < table.count; ++k) {
    for (const Point& point : both.points) {
      const Exact value = along(table, k, both, point);
      ASSERT_TRUE(merged.lower[k] <= value && value <= merged.upper[k]);
    }
  }
}

}  // namespace
}  // namespace sobb::test
