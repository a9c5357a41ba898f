// SPDX-License-Identifier: Apache-2.0
// Polygons: which the fan covers, and triangles by clipping ears, of the right number, area and
// side for whatever shape.
#include "scene/model/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "base/error.h"
#include "scene/model/scene_writer.h"

namespace sobb {
namespace {

using Polygon = std::vector<Vec3>;

Polygon flat(const std::vector<std::array<double, 2>>& points) {
  Polygon polygon;
  for (const auto& [x, y] : points) polygon.push_back({x, y, 0});
  return polygon;
}

Vec3 twice_area(const Vec3& a, const Vec3& b, const Vec3& c) { return cross(b - a, c - a); }

// The polygon's own, by Newell's formula.
double area_of(const Polygon& polygon) {
  Vec3 sum;
  for (size_t i = 2; i < polygon.size(); ++i) {
    sum = sum + twice_area(polygon[0], polygon[i - 1], polygon[i]);
  }
  return length(sum) / 2;
}

// The triangles that a scene gets for the polygon.
std::vector<Polygon> split(const Polygon& polygon) {
  Scene scene;
  SceneWriter writer("polygon", 0, scene);
  std::vector<uint64_t> corners;
  for (const Vec3& p : polygon) {
    corners.push_back(corners.size());
    writer.add_vertex(float(p.x), float(p.y), float(p.z), "here");
  }
  writer.add_polygon(corners, "here");
  writer.finish();
  std::vector<Polygon> triangles;
  for (size_t i = 0; i < scene.indices.size(); i += 3) {
    Polygon& triangle = triangles.emplace_back();
    for (size_t k = 0; k < 3; ++k)
      triangle.push_back(widen(&scene.vertices[3 * scene.indices[i + k]]));
  }
  return triangles;
}

// Expects n - 2 triangles that cover the polygon's area, and none of them turned over.
void expect_split(const Polygon& polygon, double tolerance = 1e-5) {
  const std::vector<Polygon> triangles = split(polygon);
  EXPECT_EQ(triangles.size(), polygon.size() - 2);
  Vec3 signed_sum;
  double sum = 0;
  for (const Polygon& t : triangles) {
    signed_sum = signed_sum + twice_area(t[0], t[1], t[2]);
    sum += length(twice_area(t[0], t[1], t[2])) / 2;
  }
  const double area = area_of(polygon);
  EXPECT_NEAR(sum, area, tolerance * area);
  Vec3 expected;
  for (size_t i = 2; i < polygon.size(); ++i) {
    expected = expected + twice_area(polygon[0], polygon[i - 1], polygon[i]);
  }
  EXPECT_GT(dot(signed_sum, expected), 0);
}

// The polygon begun at every corner, either way round, and laid into other planes.
void expect_split_in_every_way(const Polygon& polygon) {
  for (size_t start = 0; start < polygon.size(); ++start) {
    Polygon turned = polygon;
    std::rotate(turned.begin(), turned.begin() + std::ptrdiff_t(start), turned.end());
    for (int way = 0; way < 2; ++way) {
      SCOPED_TRACE("corner " + std::to_string(start) + ", way " + std::to_string(way));
      expect_split(turned);
      Polygon other = turned;
      for (Vec3& p : other) p = {p.z, p.x, p.y};
      expect_split(other);
      for (Vec3& p : other) p = {p.z + 3, p.x - 2, p.y};
      expect_split(other);
      for (size_t i = 0; i < turned.size(); ++i) {
        const Vec3 p = turned[i];
        other[i] = {p.x + 0.5 * p.y, 0.25 * p.x - p.y, 2 * p.x + p.y};
      }
      expect_split(other);
      std::reverse(turned.begin(), turned.end());
    }
  }
}

const Polygon kEll = flat({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 7}, {0, 7}});

TEST(Polygon, ConvexOnesKeepTheFan) {
  EXPECT_TRUE(fan_covers(flat({{0, 0}, {1, 0}, {1, 1}, {0, 1}})));
  EXPECT_TRUE(fan_covers(flat({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {0, 2}, {0, 1}})));
  EXPECT_TRUE(fan_covers(flat({{1, 0}, {2, 0}, {2, 1}, {2, 2}, {0, 2}, {0, 0}})));
  Polygon circle;
  for (int i = 0; i < 1000; ++i) {
    const SinCos angle = sin_cos(i / 1000.0);
    // A file holds them as floats.
    circle.push_back({double(float(angle.cos)), 5, double(float(angle.sin))});
  }
  EXPECT_TRUE(fan_covers(circle));
  // A corner on an edge, but for rounding, and one that comes twice.
  EXPECT_TRUE(fan_covers(flat({{0, 0}, {0.5, 1e-9}, {1, 0}, {1, 1}, {1, 1}, {0, 1}})));
  // A dart whose reflex corner is the first.
  EXPECT_TRUE(fan_covers(flat({{1, 1}, {3, 0}, {0, 0}, {0, 3}})));
}

TEST(Polygon, TheFanIsNoWayForOthers) {
  EXPECT_FALSE(fan_covers(flat({{3, 0}, {0, 0}, {0, 3}, {1, 1}})) &&
               fan_covers(flat({{0, 3}, {1, 1}, {3, 0}, {0, 0}})));
  Polygon ell = kEll;
  EXPECT_TRUE(fan_covers(ell));  // the first corner sees all others
  std::rotate(ell.begin(), ell.begin() + 1, ell.end());
  EXPECT_FALSE(fan_covers(ell));
  // A pentagram turns left at every corner, but goes round twice.
  Polygon pentagram;
  for (int i = 0; i < 5; ++i) {
    const SinCos angle = sin_cos(2 * i / 5.0);
    pentagram.push_back({angle.cos, angle.sin, 0});
  }
  EXPECT_FALSE(fan_covers(pentagram));
  // A spiral about its first corner, which is there twice.
  Polygon spiral = {{0, 0, 0}, {0, 0, 0}};
  for (int i = 0; i < 30; ++i) {
    const SinCos angle = sin_cos(i / 12.0);
    spiral.push_back({(1 + 0.1 * i) * angle.cos, (1 + 0.1 * i) * angle.sin, 0});
  }
  EXPECT_FALSE(fan_covers(spiral));
}

TEST(Polygon, ConcaveOnesHaveTheirArea) {
  EXPECT_EQ(area_of(kEll), 10);
  expect_split_in_every_way(kEll);
  expect_split_in_every_way(flat({{0, 0}, {3, 0}, {1, 1}, {0, 3}}));  // a dart
  expect_split_in_every_way(flat({{0, 0}, {4, 0}, {4, 3}, {3, 1}, {2, 3}, {1, 1}, {0, 3}}));  // W
  expect_split_in_every_way(flat({{0, 0}, {5, 0}, {5, 5}, {0, 5}, {0, 4}, {4, 4}, {4, 1}, {0, 1}}));
  // A ring, cut open: two edges lie on each other.
  expect_split_in_every_way(
      flat({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}}));
}

TEST(Polygon, CornersOnEdgesAndTwiceKeepTheCount) {
  expect_split_in_every_way(
      flat({{0, 0}, {2, 0}, {4, 0}, {4, 1}, {2, 1}, {1, 1}, {1, 4}, {1, 7}, {0, 7}, {0, 3}}));
  expect_split_in_every_way(
      flat({{0, 0}, {0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 1}, {1, 7}, {0, 7}, {0, 7}, {0, 0}}));
  // A spike of no area.
  expect_split_in_every_way(
      flat({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 7}, {0, 7}, {0, 2}, {-3, 2}, {0, 2}}));
}

// Each edge of the polygon is one of a triangle's: neighbours leave no gap, even where a corner
// lies on a straight edge.
TEST(Polygon, NeighboursLeaveNoGap) {
  const Polygon polygon = flat({{0, 0}, {2, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {1, 7}, {0, 7}});
  const std::vector<uint32_t> triangles = clip_ears(polygon);
  std::set<std::pair<uint32_t, uint32_t>> edges;
  for (size_t i = 0; i < triangles.size(); i += 3) {
    for (size_t k = 0; k < 3; ++k) edges.emplace(triangles[i + k], triangles[i + (k + 1) % 3]);
  }
  for (uint32_t i = 0; i < polygon.size(); ++i) {
    EXPECT_TRUE(edges.contains({i, (i + 1) % uint32_t(polygon.size())})) << i;
  }
}

TEST(Polygon, SelfCrossingAndDegenerateOnesKeepTheCount) {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    Polygon polygon;
    const size_t size = 4 + random() % (round < 250 ? 20 : 300);
    for (size_t i = 0; i < size; ++i) {
      // Few places, so that corners coincide and edges lie on each other.
      polygon.push_back(
          {double(random() % 5), double(random() % 4), round % 3 == 0 ? 0.0 : random() % 2});
    }
    EXPECT_EQ(split(polygon).size(), size - 2);
    EXPECT_EQ(clip_ears(polygon).size(), 3 * (size - 2));
  }
  for (const Polygon& polygon :
       {Polygon(9, Vec3{1, 2, 3}), flat({{0, 0}, {1, 1}, {2, 2}, {3, 3}, {1, 1}}),
        flat({{0, 0}, {2, 2}, {2, 0}, {0, 2}})}) {
    EXPECT_EQ(split(polygon).size(), polygon.size() - 2);
    EXPECT_EQ(clip_ears(polygon).size(), 3 * (polygon.size() - 2));
  }
}

TEST(Polygon, BentOnesAreSplitInTheirBestFitPlane) {
  Polygon bent = kEll;
  for (size_t i = 0; i < bent.size(); ++i) bent[i].z = i % 2 == 0 ? 0.2 : -0.2;
  for (const Polygon& t : split(bent)) {
    EXPECT_GT(twice_area(t[0], t[1], t[2]).z, 0);  // as seen from above
  }
}

TEST(Polygon, FarFromTheOriginAndOfAnySize) {
  for (const double scale : {1e-30, 1e-3, 1e14}) {
    for (const double away : {0.0, 1.0, 4096.0}) {
      Polygon polygon = kEll;
      for (Vec3& p : polygon) p = scale * (p + away * Vec3{1, -1, 1});
      expect_split(polygon, 1e-3);
    }
  }
}

// Large shapes that ear clipping is slow or wrong for, where it is not done with care.
std::vector<std::pair<const char*, Polygon>> large_shapes(size_t n) {
  std::vector<std::pair<const char*, Polygon>> shapes;
  const auto polar = [](double turns, double radius) {
    const SinCos angle = sin_cos(turns);
    return Vec3{radius * angle.cos, radius * angle.sin, 0};
  };
  Polygon star;
  for (size_t i = 0; i < n; ++i) star.push_back(polar(double(i) / double(n), i % 2 == 0 ? 1 : 0.5));
  Polygon comb;
  for (size_t i = 0; i + 2 < n; ++i) comb.push_back({double(i), i % 2 == 0 ? double(n) : 1, 0});
  comb.push_back({double(n), 0, 0});
  comb.push_back({0, 0, 0});
  Polygon spiral;
  Polygon zigzag;
  Polygon banana;
  const double last = double(n) / 2 - 1;
  for (size_t i = 0; i < n; ++i) {
    const bool there = i < n / 2;
    const double at = there ? double(i) : double(n - 1 - i);
    spiral.push_back(polar(10 * at / last, 1 + 60 * at / last + (there ? 0 : 1)));
    zigzag.push_back(
        {at, double(n) * (size_t(at) % 2 == 0 ? 1 : 0) + (there ? 0 : double(n) / 2), 0});
    banana.push_back({at / last, at / last * at / last + (there ? 0 : 0.1), 0});
  }
  shapes.emplace_back("star", star);
  shapes.emplace_back("comb", comb);
  shapes.emplace_back("spiral", spiral);
  shapes.emplace_back("zigzag", zigzag);
  shapes.emplace_back("banana", banana);
  return shapes;
}

TEST(Polygon, LargeOnesHaveTheirArea) {
  for (const size_t n : {90U, 1000U, 100'000U}) {
    for (const auto& [name, polygon] : large_shapes(n)) {
      SCOPED_TRACE(name + std::to_string(n));
      expect_split(polygon, 1e-4);
    }
  }
}

TEST(Polygon, TheAllowanceEndsTheWork) {
  std::mt19937 random(1);
  Polygon polygon;
  for (int i = 0; i < 20'000; ++i) polygon.push_back({double(random()), double(random()), 0});
  size_t turns = 0;
  const std::vector<uint32_t> triangles =
      clip_ears(polygon, [&turns]() -> size_t { return ++turns < 100 ? 4096 : 0; });
  EXPECT_EQ(turns, 100U);
  EXPECT_EQ(triangles.size(), 3 * (polygon.size() - 2));
}

// It crosses itself everywhere: cubic work, were it not for the limit. It can be cancelled.
TEST(Polygon, ScenesLimitAndCancelTheWork) {
  std::mt19937 random(1);
  Scene scene;
  uint64_t calls = 0;
  struct Caller {
    uint64_t calls = 0;
    uint64_t stop_at = ~uint64_t(0);
    static int on_progress(void* user, double) {
      auto* self = static_cast<Caller*>(user);
      return ++self->calls >= self->stop_at ? 1 : 0;
    }
  } caller;
  Progress progress(Caller::on_progress, &caller);
  SceneWriter writer("file", 0, scene, &progress);
  std::vector<uint64_t> corners;
  for (uint64_t i = 0; i < 20'000; ++i) {
    writer.add_vertex(float(random()), float(random()), 0, "here");
    corners.push_back(i);
  }
  writer.add_polygon(corners, "here");
  EXPECT_EQ(scene.indices.size(), 3 * (corners.size() - 2));
  calls = caller.calls;
  EXPECT_GT(calls, 20U);
  caller.stop_at = calls + 10;
  EXPECT_THROW(writer.add_polygon(corners, "here"), Error);
  EXPECT_EQ(caller.calls, calls + 10);
}

TEST(Polygon, MemoryIsHeldAgainstTheLimit) {
  Scene scene;
  SceneWriter writer("file", 1 << 20, scene);
  std::vector<uint64_t> corners;
  const Polygon star = large_shapes(3000).front().second;
  for (const Vec3& p : star) {
    corners.push_back(corners.size());
    writer.add_vertex(float(p.x), float(p.y), 0, "here");
  }
  EXPECT_NO_THROW(writer.add_polygon(std::span(corners).first(2000), "here"));
  writer.hold(writer.memory_left() - 100'000);
  EXPECT_THROW(writer.add_polygon(corners, "here"), Error);
}

}  // namespace
}  // namespace sobb
