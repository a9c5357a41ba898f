// SPDX-License-Identifier: Apache-2.0
// The seam at which a candidate becomes a hit: the interval, the order of ties, and conditions.
// The lanes of the packet kernel decide as acceptance.h does: test_acceptance_lanes.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "trace/triangles/acceptance.h"
#include "trace/triangles/closest_hit.h"

namespace sobb::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Even {
  static bool allows(const Candidate& candidate) { return candidate.primitive % 2 == 0; }
};
struct BeyondOne {
  static bool allows(const Candidate& candidate) { return candidate.t > 1; }
};

TEST(Acceptance, TakesBothEndsOfTheInterval) {
  const Candidate none = {4, SOBB_MISS};
  EXPECT_TRUE(accepts({1, 7}, 1, none));
  EXPECT_TRUE(accepts({4, 7}, 1, none));
  EXPECT_FALSE(accepts({0.99F, 7}, 1, none));
  EXPECT_FALSE(accepts({4.01F, 7}, 1, none));
}

TEST(Acceptance, GivesTiesToTheLowestPrimitive) {
  EXPECT_TRUE(accepts({2, 3}, 0, {2, 4}));
  EXPECT_FALSE(accepts({2, 4}, 0, {2, 4}));
  EXPECT_FALSE(accepts({2, 5}, 0, {2, 4}));
  EXPECT_TRUE(accepts({1.5F, 5}, 0, {2, 4}));
}

TEST(Acceptance, TakesNoDistanceThatIsNotANumber) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(accepts({nan, 0}, 0, {kInfinity, SOBB_MISS}));
}

TEST(Acceptance, AsksEveryCondition) {
  using Both = Conditions<Even, BeyondOne>;
  const Candidate none = {kInfinity, SOBB_MISS};
  EXPECT_TRUE(accepts<Both>({2, 4}, 0, none));
  EXPECT_FALSE(accepts<Both>({2, 5}, 0, none));
  EXPECT_FALSE(accepts<Both>({0.5F, 4}, 0, none));
  EXPECT_FALSE(accepts<Both>({2, 4}, 3, none)) << "and the interval still";
  EXPECT_FALSE(Both::kNone);
  EXPECT_TRUE(QueryConditions::kNone);
}

TEST(ClosestHit, KeepsTheNearestAndOfEqualsTheLowest) {
  const sobb_ray ray = {{0, 0, 0}, 1, {0, 0, 1}, 5};
  ClosestHit best(ray);
  EXPECT_EQ(best.result().primitive, SOBB_MISS);
  EXPECT_EQ(best.result().t, kInfinity);
  EXPECT_FALSE(best.offer({0.5F, 0, 0}, ray.tmin, 1)) << "before tmin";
  EXPECT_FALSE(best.offer({5.5F, 0, 0}, ray.tmin, 1)) << "beyond tmax";
  EXPECT_TRUE(best.offer({5, 0, 0}, ray.tmin, 9)) << "at tmax";
  EXPECT_TRUE(best.offer({3, 0.1F, 0.2F}, ray.tmin, 7));
  EXPECT_FALSE(best.offer({3, 0, 0}, ray.tmin, 8));
  EXPECT_FALSE(best.offer({3, 0, 0}, ray.tmin, 7));
  EXPECT_TRUE(best.offer({3, 0.3F, 0.4F}, ray.tmin, 2));
  EXPECT_FALSE(best.offer({kInfinity, 0, 0}, ray.tmin, 0));
  EXPECT_FALSE(best.offer({NAN, 0, 0}, ray.tmin, 0));
  EXPECT_TRUE(best.offer({1, 0.5F, 0.5F}, ray.tmin, 3)) << "at tmin";
  const sobb_hit hit = best.result();
  EXPECT_EQ(hit.primitive, 3u);
  EXPECT_EQ(hit.t, 1);
  EXPECT_EQ(hit.u, 0.5F);
  EXPECT_EQ(hit.geometry, 0u);
}

}  // namespace
}  // namespace sobb::test
