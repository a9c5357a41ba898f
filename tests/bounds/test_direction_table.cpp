// SPDX-License-Identifier: Apache-2.0
// The default direction sets are what docs/direction-tables.md says.
#include "bounds/directions/direction_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.h"

namespace sobb {
namespace {

struct Vector {
  double x, y, z;
};

Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector operator-(Vector a) { return {-a.x, -a.y, -a.z}; }
double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double degrees(double cosine) { return std::acos(cosine) * 180 / std::numbers::pi; }

std::vector<Vector> vectors(std::span<const Direction> directions) {
  std::vector<Vector> result;
  for (const Direction& d : directions) result.push_back({d.x, d.y, d.z});
  return result;
}

// The cosine of the angle between `direction` and the nearest of the lines along `lines`.
double nearest(const std::vector<Vector>& lines, Vector direction) {
  double cosine = 0;
  for (Vector line : lines) cosine = std::max(cosine, std::abs(dot(line, direction)));
  return cosine;
}

double smallest_angle(const std::vector<Vector>& lines) {
  double cosine = 0;
  for (size_t i = 1; i < lines.size(); ++i) {
    cosine = std::max(cosine, nearest({lines.begin(), lines.begin() + i}, lines[i]));
  }
  return degrees(cosine);
}

// The direction that is furthest from every line is equally far from three of them. So the largest
// empty circle passes through some a, b and c, or their opposites. The generator finds it in
// another way, by a convex hull.
double covering_radius(const std::vector<Vector>& lines) {
  double cosine = 1;
  const auto try_circle = [&](Vector a, Vector b, Vector c) {
    Vector centre = cross(b - a, c - a);
    const double length = std::sqrt(dot(centre, centre));
    centre = {centre.x / length, centre.y / length, centre.z / length};
    const double radius = std::abs(dot(centre, a));
    const bool empty = std::none_of(lines.begin(), lines.end(), [&](Vector line) {
      return std::abs(dot(line, centre)) > radius + 1e-9;
    });
    if (empty) cosine = std::min(cosine, radius);
  };
  for (size_t i = 0; i < lines.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      for (size_t k = 0; k < j; ++k) {
        try_circle(lines[i], lines[j], lines[k]);
        try_circle(lines[i], -lines[j], lines[k]);
        try_circle(lines[i], lines[j], -lines[k]);
        try_circle(lines[i], -lines[j], -lines[k]);
      }
    }
  }
  return degrees(cosine);
}

sobb_status status_of(const auto& body) {
  try {
    body();
  } catch (const Error& error) {
    return error.status;
  }
  return SOBB_OK;
}

struct Figures {
  uint32_t k;
  double smallest_angle, covering_radius;  // as documented, in degrees
};

class DefaultDirections : public testing::TestWithParam<Figures> {};

TEST_P(DefaultDirections, BeginWithTheAxes) {
  const auto directions = default_directions(GetParam().k);
  ASSERT_EQ(directions.size(), GetParam().k / 2);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(directions[i].x, i == 0);
    EXPECT_EQ(directions[i].y, i == 1);
    EXPECT_EQ(directions[i].z, i == 2);
  }
}

TEST_P(DefaultDirections, AreUnitWithinRounding) {
  for (Vector n : vectors(default_directions(GetParam().k))) {
    EXPECT_NEAR(std::sqrt(dot(n, n)), 1, 1e-6);
  }
}

TEST_P(DefaultDirections, PointIntoOneHalfSpace) {
  for (const Direction& d : default_directions(GetParam().k)) {
    EXPECT_TRUE(d.z > 0 || (d.z == 0 && (d.y > 0 || (d.y == 0 && d.x > 0))));
  }
}

TEST_P(DefaultDirections, HaveTheDocumentedFigures) {
  const auto lines = vectors(default_directions(GetParam().k));
  EXPECT_NEAR(smallest_angle(lines), GetParam().smallest_angle, 0.005001);
  EXPECT_NEAR(covering_radius(lines), GetParam().covering_radius, 0.005001);
}

TEST_P(DefaultDirections, FillATablePaddedWithZeros) {
  const auto directions = default_directions(GetParam().k);
  if (directions.size() > kMaxDirections) {
    EXPECT_EQ(status_of([&] { make_direction_table(directions); }), SOBB_ERROR_INVALID_ARGUMENT);
    return;
  }
  const DirectionTable table = make_direction_table(directions);
  ASSERT_EQ(table.count, directions.size());
  for (uint32_t i = 0; i < kMaxDirections; ++i) {
    const Direction expected = i < directions.size() ? directions[i] : Direction{};
    EXPECT_EQ(table.x[i], expected.x);
    EXPECT_EQ(table.y[i], expected.y);
    EXPECT_EQ(table.z[i], expected.z);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryK, DefaultDirections,
                         testing::Values(Figures{6, 90, 54.74}, Figures{32, 24.06, 24.16},
                                         Figures{48, 25.62, 18.82}, Figures{64, 22.89, 16.24},
                                         Figures{128, 13.18, 11.59}, Figures{256, 9.53, 8.23}),
                         [](const auto& info) { return "k" + std::to_string(info.param.k); });

TEST(DirectionTable, RefusesOtherKs) {
  for (uint32_t k : {0u, 3u, 31u, 33u, 62u, 66u, 127u, 257u, ~0u}) {
    EXPECT_EQ(status_of([&] { default_directions(k); }), SOBB_ERROR_INVALID_ARGUMENT) << k;
  }
}

TEST(DirectionTable, RefusesMoreThanItHolds) {
  const std::vector<Direction> directions(kMaxDirections + 1, Direction{1, 0, 0});
  EXPECT_EQ(status_of([&] { make_direction_table(directions); }), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(status_of([] { make_direction_table({}); }), SOBB_ERROR_INVALID_ARGUMENT);
}

}  // namespace
}  // namespace sobb
