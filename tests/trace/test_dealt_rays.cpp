// SPDX-License-Identifier: Apache-2.0
// Rays dealt out among modes: each gets its share, from all over the task, and results come back in
// the order of the rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "trace/schedule/dealt_rays.h"

namespace sobb::test {
namespace {

using Dealt = DealtRays<uint8_t>;
constexpr uint32_t kShares[][kTraceModes] = {
    {Dealt::kRuns, 0, 0}, {24, 4, 4}, {16, 14, 2}, {4, 0, 28}, {0, 0, Dealt::kRuns}, {1, 30, 1}};

// Rays that know their number.
std::vector<sobb_ray> numbered() {
  std::vector<sobb_ray> rays(kBatchRays);
  for (uint32_t i = 0; i < kBatchRays; ++i) rays[i].tmax = static_cast<float>(i);
  return rays;
}
uint32_t number(const sobb_ray& ray) { return static_cast<uint32_t>(ray.tmax); }

TEST(DealtRays, EachWayGetsItsShareOnceAndInOrder) {
  const std::vector<sobb_ray> rays = numbered();
  const auto dealt = std::make_unique<Dealt>();
  for (const auto& shares : kShares) {
    dealt->deal(rays.data(), shares);
    std::vector<int> seen(kBatchRays, 0);
    for (size_t mode = 0; mode < kTraceModes; ++mode) {
      for (uint32_t i = 0; i < shares[mode] * Dealt::kRun; ++i) {
        const uint32_t at = number(dealt->rays(mode)[i]);
        ++seen[at];
        if (i % Dealt::kRun != 0) {
          EXPECT_EQ(at, number(dealt->rays(mode)[i - 1]) + 1) << "a run";
        } else if (i != 0) {
          EXPECT_GT(at, number(dealt->rays(mode)[i - 1]));
        }
      }
    }
    for (const int times : seen) EXPECT_EQ(times, 1);
  }
}

// Modes are compared over rays that cost alike, so each mode has its share of any first part of the
// task, to a run or two.
TEST(DealtRays, SharesComeFromAllOverTheTask) {
  const std::vector<sobb_ray> rays = numbered();
  const auto dealt = std::make_unique<Dealt>();
  for (const auto& shares : kShares) {
    dealt->deal(rays.data(), shares);
    for (size_t mode = 0; mode < kTraceModes; ++mode) {
      for (uint32_t run = 0; run < shares[mode]; ++run) {
        const uint32_t at = number(dealt->rays(mode)[size_t{run} * Dealt::kRun]) / Dealt::kRun;
        const double due = (run + 0.5) * Dealt::kRuns / shares[mode];
        const double apart = std::max(2.0, 1.0 * Dealt::kRuns / shares[mode]);
        EXPECT_NEAR(at, due, apart) << "mode " << mode << " run " << run;
      }
    }
  }
}

TEST(DealtRays, ResultsComeBackInTheOrderOfTheRays) {
  const std::vector<sobb_ray> rays = numbered();
  const auto dealt = std::make_unique<Dealt>();
  for (const auto& shares : kShares) {
    dealt->deal(rays.data(), shares);
    for (size_t mode = 0; mode < kTraceModes; ++mode) {
      for (uint32_t i = 0; i < shares[mode] * Dealt::kRun; ++i) {
        dealt->results(mode)[i] = static_cast<uint8_t>(number(dealt->rays(mode)[i]) % 251);
      }
    }
    std::vector<uint8_t> results(kBatchRays);
    dealt->collect(results.data());
    for (uint32_t i = 0; i < kBatchRays; ++i) EXPECT_EQ(results[i], i % 251);
  }
}

}  // namespace
}  // namespace sobb::test
