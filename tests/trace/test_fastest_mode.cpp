// SPDX-License-Identifier: Apache-2.0
// The choice among modes to trace, by what tasks are said to have taken.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

#include "trace/schedule/fastest_mode.h"

namespace sobb::test {
namespace {

constexpr size_t kModes = 3;
constexpr uint32_t kAll = 0b111;
using Fastest = FastestMode<kModes>;

// Tasks in their order, whose modes take what `time` says of one. Returns how many each mode was
// the best for.
struct Uses {
  uint64_t of[kModes] = {};
};
template <class Time>
Uses run(Fastest& fastest, uint64_t begin, uint64_t end, const Time& time) {
  Uses uses;
  for (uint64_t task = begin; task < end; ++task) {
    const Fastest::Turn turn = fastest.turn(task);
    ++uses.of[turn.best];
    if (!turn.compares) continue;
    float times[kModes] = {};
    for (size_t mode = 0; mode < kModes; ++mode) {
      if (fastest.has(mode)) times[mode] = time(mode);
    }
    fastest.took(times);
  }
  return uses;
}

TEST(FastestMode, BeginsWithTheOneAskedFor) {
  for (size_t first = 0; first < kModes; ++first) {
    Fastest fastest(kAll, first);
    EXPECT_EQ(fastest.turn(0).best, first);
    EXPECT_FALSE(fastest.turn(0).compares) << "the first task is not like the others";
  }
}

TEST(FastestMode, ComparesSoonThenNowAndThen) {
  Fastest fastest(kAll, 2);
  EXPECT_TRUE(fastest.turn(1).compares);
  EXPECT_FALSE(fastest.turn(2).compares);
  EXPECT_TRUE(fastest.turn(4).compares);
  constexpr uint64_t kLate = 1000 * Fastest::kTasksPerComparison;
  uint64_t comparisons = 0;
  for (uint64_t i = 0; i < 100; ++i) comparisons += fastest.turn(kLate + i).compares ? 1 : 0;
  EXPECT_EQ(comparisons, (100 + Fastest::kTasksPerComparison - 1) / Fastest::kTasksPerComparison);
}

TEST(FastestMode, KeepsToTheFastest) {
  constexpr uint64_t kTasks = 400;
  for (size_t first = 0; first < kModes; ++first) {
    for (size_t faster = 0; faster < kModes; ++faster) {
      Fastest fastest(kAll, first);
      const Uses uses =
          run(fastest, 0, kTasks, [&](size_t mode) { return mode == faster ? 1.0F : 1.1F; });
      EXPECT_EQ(uses.of[faster], first == faster ? kTasks : kTasks - 2);
    }
  }
}

TEST(FastestMode, TakesNoneThatThereIsNot) {
  Fastest fastest(0b101, 2);
  EXPECT_FALSE(fastest.has(1));
  const Uses uses = run(fastest, 0, 400, [](size_t mode) { return mode == 0 ? 3.0F : 4.0F; });
  EXPECT_EQ(uses.of[1], 0U);
  EXPECT_EQ(uses.of[0], 398U);
}

TEST(FastestMode, KnowsWhatIsFarBehind) {
  Fastest fastest(kAll, 0);
  EXPECT_EQ(fastest.turn(1).behind, 0U) << "nothing is known";
  fastest.took({1, 1.4F, 1.6F});
  EXPECT_EQ(fastest.turn(4).behind, 0b100U);
  fastest.took({2, 1, 1});
  EXPECT_EQ(fastest.turn(16).best, 1U);
  EXPECT_EQ(fastest.turn(16).behind, 0U);
}

TEST(FastestMode, FollowsRaysThatChange) {
  constexpr uint64_t kTasks = 40 * Fastest::kTasksPerComparison;
  for (size_t then = 0; then < 2; ++then) {
    Fastest fastest(kAll, 0);
    run(fastest, 0, kTasks, [&](size_t mode) { return mode == then ? 1.0F : 3.0F; });
    const Uses uses = run(fastest, kTasks, 2 * kTasks,
                          [&](size_t mode) { return mode == 1 - then ? 1.0F : 3.0F; });
    EXPECT_GE(uses.of[1 - then], kTasks - 3 * Fastest::kTasksPerComparison);
  }
}

// Rays that miss all say little of those that do not.
TEST(FastestMode, IsNotBoundByRaysThatCostNothing) {
  Fastest fastest(kAll, 0);
  constexpr uint64_t kEmpty = 40 * Fastest::kTasksPerComparison;
  constexpr float kSky[] = {1, 4, 8};
  run(fastest, 0, kEmpty, [&](size_t mode) { return kSky[mode]; });
  constexpr float kCrowd[] = {100, 70, 90};
  run(fastest, kEmpty, kEmpty + 1, [&](size_t mode) { return kCrowd[mode]; });
  EXPECT_EQ(fastest.turn(kEmpty + 1).best, 1U);
}

TEST(FastestMode, IsNotLedAstrayByOneTask) {
  Fastest fastest(kAll, 0);
  run(fastest, 0, 400, [](size_t mode) { return mode == 0 ? 1.0F : 1.4F; });
  fastest.took({1.6F, 1.4F, 1.4F});  // held up by another program
  EXPECT_EQ(fastest.turn(401).best, 0U);
}

}  // namespace
}  // namespace sobb::test
