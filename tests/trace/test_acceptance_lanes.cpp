// SPDX-License-Identifier: Apache-2.0
// The lanes of the packet kernel accept what acceptance.h accepts, on every instruction set.
#include "base/instruction_sets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/test_acceptance_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/ray/ray_vectors-inl.h"
#include "trace/triangles/acceptance_lanes-inl.h"

#ifndef SOBB_TESTS_TRACE_TEST_ACCEPTANCE_LANES
#define SOBB_TESTS_TRACE_TEST_ACCEPTANCE_LANES
#include <gtest/gtest.h>

#include <string>

#include "support/soups.h"

namespace sobb::test {

struct NotByThree {
  static bool allows(const Candidate& candidate) { return candidate.primitive % 3 != 0; }
};
struct Far {
  static bool allows(const Candidate& candidate) { return candidate.t > 1; }
};

}  // namespace sobb::test
#endif

HWY_BEFORE_NAMESPACE();
namespace sobb::test {
namespace HWY_NAMESPACE {
namespace {

using namespace sobb::HWY_NAMESPACE;
namespace hn = hwy::HWY_NAMESPACE;

// Few different values, so that ties and ends of intervals occur.
template <class List>
void expect_lanes_accept_as_one_ray(Random& random) {
  const RayFloats d;
  const RayWords dw;
  for (int round = 0; round < 5000; ++round) {
    alignas(64) float t[kRayLanes];
    alignas(64) float tmin[kRayLanes];
    alignas(64) float limit[kRayLanes];
    alignas(64) uint32_t best[kRayLanes];
    const uint32_t primitive = random.below(8);
    for (uint32_t i = 0; i < kRayLanes; ++i) {
      t[i] = static_cast<float>(random.below(5)) * 0.5F - 0.5F;
      tmin[i] = static_cast<float>(random.below(3)) * 0.5F;
      limit[i] = static_cast<float>(random.below(5)) * 0.5F;
      best[i] = random.below(4) == 0 ? SOBB_MISS : random.below(8);
    }
    const auto taken = accepting_lanes<List>(d, hn::Load(d, t), primitive, hn::Load(d, tmin),
                                             hn::Load(d, limit), hn::Load(dw, best));
    const uint32_t bits = mask_bits(d, taken);
    for (uint32_t i = 0; i < kRayLanes; ++i) {
      ASSERT_EQ((bits >> i & 1) != 0,
                accepts<List>({t[i], primitive}, tmin[i], {limit[i], best[i]}))
          << "lane " << i << ": t " << t[i] << " primitive " << primitive << " tmin " << tmin[i]
          << " limit " << limit[i] << " best " << best[i];
    }
  }
}

}  // namespace

void test_acceptance_lanes() {
  const uint64_t seed = 23;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  expect_lanes_accept_as_one_ray<Conditions<>>(random);
  expect_lanes_accept_as_one_ray<Conditions<NotByThree>>(random);
  expect_lanes_accept_as_one_ray<Conditions<NotByThree, Far>>(random);
}

}  // namespace HWY_NAMESPACE
}  // namespace sobb::test
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sobb::test {

HWY_EXPORT(test_acceptance_lanes);

TEST(AcceptanceLanes, AcceptWhatOneRayAccepts) {
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    HWY_DYNAMIC_DISPATCH(test_acceptance_lanes)();
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace sobb::test
#endif
