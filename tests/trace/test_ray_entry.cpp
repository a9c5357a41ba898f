// SPDX-License-Identifier: Apache-2.0
// An entry of a list of rays: its order and its bounds.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <string>

#include "support/soups.h"
#include "trace/batch/ray_entry.h"
#include "trace/trace.h"

namespace sobb::test {
namespace {

RayEntry entry_of(float distance, uint32_t ray) {
  return (std::bit_cast<uint32_t>(distance) & kEntryDistance) | ray;
}

TEST(RayEntry, HasRoomForEveryRayOfABatch) {
  static_assert((kEntryDistance & (kBatchRays - 1)) == 0);
  for (uint32_t ray = 0; ray < kBatchRays; ++ray) {
    EXPECT_EQ(entry_ray(entry_of(1.5F, ray)), ray);
    EXPECT_EQ(entry_distance(entry_of(1.5F, ray)), 1.5F);
  }
}

TEST(RayEntry, DistanceIsRoundedDownAndOrders) {
  const uint64_t seed = 41;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto any_distance = [&] {  // denormal to the largest
    return std::bit_cast<float>(random.below(std::bit_cast<uint32_t>(kInfinity)));
  };
  for (int i = 0; i < 100000; ++i) {
    const float near = any_distance();
    const float far = any_distance();
    const RayEntry a = entry_of(near, random.below(kBatchRays));
    const RayEntry b = entry_of(far, random.below(kBatchRays));
    ASSERT_LE(entry_distance(a), near);
    ASSERT_GE(entry_distance(a) * 1.01F + 0x1p-132F, near);
    if (entry_distance(a) < entry_distance(b)) {
      ASSERT_LT(a, b) << near << " and " << far;
    }
  }
  EXPECT_EQ(entry_distance(entry_of(0, 5)), 0);
  EXPECT_EQ(entry_distance(entry_of(kInfinity, 5)), kInfinity);
}

}  // namespace
}  // namespace sobb::test
