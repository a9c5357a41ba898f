// SPDX-License-Identifier: Apache-2.0
// The triangle test that decides, the hit that is kept, and the order of the traversal's stack.
#include "trace/triangles/triangle_test.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "support/soups.h"
#include "trace/nodes/stack_key.h"

namespace sobb::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// The corners as the mesh has them; the ray permutes the axes.
std::optional<TriangleHit> hit_of(const sobb_ray& ray, const float corner[3][3]) {
  const TriangleRay permuted(ray);
  float at[3][3];  // [axis][corner]
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) at[k][i] = corner[i][permuted.axis[k]];
  }
  TriangleHit hit;
  if (!intersect_triangle(permuted, at[0], at[1], at[2], hit)) return std::nullopt;
  return hit;
}

constexpr float kFlat[3][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};

TEST(Triangle, HitHasDistanceAndWeights) {
  const auto hit = hit_of({{1, 2, 3}, 0, {0, 0, -2}, kInfinity}, kFlat);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 1.5F);
  EXPECT_EQ(hit->u, 0.25F);
  EXPECT_EQ(hit->v, 0.5F);
}

TEST(Triangle, EdgesAndCornersBelongToIt) {
  for (const auto& [x, y] : {std::pair(0.0F, 0.0F),
                             {4.0F, 0.0F},
                             {0.0F, 4.0F},
                             {2.0F, 0.0F},
                             {0.0F, 3.0F},
                             {1.0F, 3.0F}}) {
    EXPECT_TRUE(hit_of({{x, y, 1}, 0, {0, 0, -1}, kInfinity}, kFlat)) << x << " " << y;
    EXPECT_TRUE(hit_of({{x, y, -1}, 0, {0, 0, 1}, kInfinity}, kFlat)) << x << " " << y;
  }
  EXPECT_FALSE(hit_of({{-1e-30F, 2, 1}, 0, {0, 0, -1}, kInfinity}, kFlat));
  EXPECT_FALSE(hit_of({{2, -1e-30F, 1}, 0, {0, 0, -1}, kInfinity}, kFlat));
  EXPECT_FALSE(hit_of({{2, std::nextafter(2.0F, 3.0F), 1}, 0, {0, 0, -1}, kInfinity}, kFlat));
}

TEST(Triangle, BehindEdgeOnAndDegenerateAreMissed) {
  EXPECT_FALSE(hit_of({{1, 1, -0x1p-149F}, 0, {0, 0, -1}, kInfinity}, kFlat)) << "behind";
  EXPECT_TRUE(hit_of({{1, 1, 0}, 0, {0, 0, -1}, kInfinity}, kFlat)) << "at the origin";
  EXPECT_FALSE(hit_of({{-1, 1, 0}, 0, {1, 0, 0}, kInfinity}, kFlat)) << "edge-on";
  const float line[3][3] = {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}};
  EXPECT_FALSE(hit_of({{1, 1, 1}, 0, {0, 0, -1}, kInfinity}, line));
  const float point[3][3] = {{1, 1, 0}, {1, 1, 0}, {1, 1, 0}};
  EXPECT_FALSE(hit_of({{1, 1, 1}, 0, {0, 0, -1}, kInfinity}, point));
}

TEST(Triangle, HitLiesInTheTriangleAndOnTheRay) {
  constexpr uint64_t kSeed = 111;
  Random random(kSeed);
  const Soup soup = random_soup(kSeed, 2000, 0.5);
  int hits = 0;
  for (uint64_t t = 0; t < 2000; ++t) {
    float corner[3][3];
    sobb_ray ray = {{0, 0, 0}, 0, {0, 0, 0}, kInfinity};
    double target[3] = {};
    const double weight[3] = {random.uniform(), random.uniform(), random.uniform()};
    const double sum = weight[0] + weight[1] + weight[2];
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 3; ++i) {
        corner[i][k] = soup.corner(t, i)[k];
        target[k] += weight[i] / sum * corner[i][k];
      }
      ray.origin[k] = random.between(-2, 2);
      ray.direction[k] = static_cast<float>(target[k] - ray.origin[k]);
    }
    const auto hit = hit_of(ray, corner);
    if (!hit) continue;  // rounded off a sliver
    ++hits;
    EXPECT_GE(hit->u, 0);
    EXPECT_GE(hit->v, 0);
    EXPECT_LE(static_cast<double>(hit->u) + hit->v, 1 + 1e-6);
    for (int k = 0; k < 3; ++k) {
      const double of_triangle = (1.0 - hit->u - hit->v) * corner[0][k] +
                                 static_cast<double>(hit->u) * corner[1][k] +
                                 static_cast<double>(hit->v) * corner[2][k];
      const double of_ray = ray.origin[k] + static_cast<double>(hit->t) * ray.direction[k];
      EXPECT_NEAR(of_triangle, of_ray, 1e-5) << "seed " << kSeed << " triangle " << t;
    }
  }
  EXPECT_GT(hits, 1900);
}

TEST(Triangle, NeighboursLeaveNoGap) {
  constexpr uint64_t kSeed = 112;
  Random random(kSeed);
  for (int round = 0; round < 20'000; ++round) {
    // Two triangles on both sides of an edge a-b, and a ray at a point of the edge.
    float a[3];
    float b[3];
    float c[3];
    float d[3];
    sobb_ray ray = {{0, 0, 0}, 0, {0, 0, 0}, kInfinity};
    const double s = random.uniform();
    for (int k = 0; k < 2; ++k) {
      a[k] = random.between(-1, 1);
      b[k] = random.between(-1, 1);
      ray.origin[k] = random.between(-0.1, 0.1);
      ray.direction[k] = static_cast<float>(a[k] + s * (static_cast<double>(b[k]) - a[k]));
    }
    // Points c and d lie to the left and the right of the edge as the ray sees it, all four at a
    // like depth.
    const float x = b[1] - a[1];
    const float y = a[0] - b[0];
    for (float* point : {a, b, c, d}) point[2] = random.between(1.9, 2.1);
    for (int k = 0; k < 2; ++k) {
      const float side = k == 0 ? x : y;
      c[k] = (a[k] + b[k]) / 2 + 10 * side;
      d[k] = (a[k] + b[k]) / 2 - 10 * side;
      ray.direction[k] -= ray.origin[k];
    }
    ray.direction[2] = 2;
    const float first[3][3] = {{a[0], a[1], a[2]}, {b[0], b[1], b[2]}, {c[0], c[1], c[2]}};
    const float second[3][3] = {{b[0], b[1], b[2]}, {a[0], a[1], a[2]}, {d[0], d[1], d[2]}};
    if (std::hypot(x, y) < 0.5F || s < 0.3 || s > 0.7) continue;
    ASSERT_TRUE(hit_of(ray, first) || hit_of(ray, second)) << "seed " << kSeed << " " << round;
  }
}

TEST(StackKey, LastKeyNeverCullsWhatIsAsNear) {
  constexpr uint64_t kSeed = 113;
  Random random(kSeed);
  for (int round = 0; round < 100'000; ++round) {
    const float limit = std::ldexp(static_cast<float>(1 + random.uniform()),
                                   static_cast<int>(random.below(250)) - 125);
    // A key at that very distance, whatever it names.
    const StackKey meta = random.below(kKeyMetaMask + 1);
    const auto distance = static_cast<StackKey>(std::bit_cast<uint32_t>(limit) & ~kKeyMetaMask);
    const StackKey key = (distance | meta) << 32 | static_cast<uint32_t>(random.bits());
    ASSERT_LE(key, last_key(limit)) << "seed " << kSeed << " limit " << limit;
    const auto beyond =
        static_cast<StackKey>(std::bit_cast<uint32_t>(limit * 1.0001F) & ~kKeyMetaMask);
    ASSERT_GT(beyond << 32, last_key(limit)) << "seed " << kSeed << " limit " << limit;
  }
}

}  // namespace
}  // namespace sobb::test
