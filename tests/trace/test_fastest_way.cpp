// SPDX-License-Identifier: Apache-2.0
// The choice among ways to trace, by what tasks are said to have taken.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

#include "trace/schedule/fastest_mode.h"

namespace sobb::test {
namespace {

constexpr size_t kWays = 3;
constexpr uint32_t kAll = 0b111;
using Fastest = FastestWay<kWays>;

// Tasks in their order, whose ways take what `time` says of one. Returns how many each way was the
// best for.
struct Uses {
  uint64_t of[kWays] = {};
};
template <class Time>
Uses run(Fastest& fastest, uint64_t begin, uint64_t end, const Time& time) {
  Uses uses;
  for (uint64_t task = begin; task < end; ++task) {
    const Fastest::Turn turn = fastest.turn(task);
    ++uses.of[turn.best];
    if (!turn.compares) continue;
    float times[kWays] = {};
    for (size_t way = 0; way < kWays; ++way) {
      if (fastest.has(way)) times[way] = time(way);
    }
    fastest.took(times);
  }
  return uses;
}

TEST(FastestWay, BeginsWithTheOneAskedFor) {
  for (size_t first = 0; first < kWays; ++first) {
    Fastest fastest(kAll, first);
    EXPECT_EQ(fastest.turn(0).best, first);
    EXPECT_FALSE(fastest.turn(0).compares) << "the first task is not like the others";
  }
}

TEST(FastestWay, ComparesSoonThenNowAndThen) {
  Fastest fastest(kAll, 2);
  EXPECT_TRUE(fastest.turn(1).compares);
  EXPECT_FALSE(fastest.turn(2).compares);
  EXPECT_TRUE(fastest.turn(4).compares);
  constexpr uint64_t kLate = 1000 * Fastest::kTasksAComparison;
  uint64_t comparisons = 0;
  for (uint64_t i = 0; i < 100; ++i) comparisons += fastest.turn(kLate + i).compares ? 1 : 0;
  EXPECT_EQ(comparisons, (100 + Fastest::kTasksAComparison - 1) / Fastest::kTasksAComparison);
}

TEST(FastestWay, KeepsToTheFastest) {
  constexpr uint64_t kTasks = 400;
  for (size_t first = 0; first < kWays; ++first) {
    for (size_t faster = 0; faster < kWays; ++faster) {
      Fastest fastest(kAll, first);
      const Uses uses =
          run(fastest, 0, kTasks, [&](size_t way) { return way == faster ? 1.0F : 1.1F; });
      EXPECT_EQ(uses.of[faster], first == faster ? kTasks : kTasks - 2);
    }
  }
}

TEST(FastestWay, TakesNoneThatThereIsNot) {
  Fastest fastest(0b101, 2);
  EXPECT_FALSE(fastest.has(1));
  const Uses uses = run(fastest, 0, 400, [](size_t way) { return way == 0 ? 3.0F : 4.0F; });
  EXPECT_EQ(uses.of[1], 0U);
  EXPECT_EQ(uses.of[0], 398U);
}

TEST(FastestWay, KnowsWhatIsFarBehind) {
  Fastest fastest(kAll, 0);
  EXPECT_EQ(fastest.turn(1).behind, 0U) << "nothing is known";
  fastest.took({1, 1.4F, 1.6F});
  EXPECT_EQ(fastest.turn(4).behind, 0b100U);
  fastest.took({2, 1, 1});
  EXPECT_EQ(fastest.turn(16).best, 1U);
  EXPECT_EQ(fastest.turn(16).behind, 0U);
}

TEST(FastestWay, FollowsRaysThatChange) {
  constexpr uint64_t kTasks = 40 * Fastest::kTasksAComparison;
  for (size_t then = 0; then < 2; ++then) {
    Fastest fastest(kAll, 0);
    run(fastest, 0, kTasks, [&](size_t way) { return way == then ? 1.0F : 3.0F; });
    const Uses uses =
        run(fastest, kTasks, 2 * kTasks, [&](size_t way) { return way == 1 - then ? 1.0F : 3.0F; });
    EXPECT_GE(uses.of[1 - then], kTasks - 3 * Fastest::kTasksAComparison);
  }
}

// Rays that miss all say little of those that do not.
TEST(FastestWay, IsNotBoundByRaysThatCostNothing) {
  Fastest fastest(kAll, 0);
  constexpr uint64_t kEmpty = 40 * Fastest::kTasksAComparison;
  constexpr float kSky[] = {1, 4, 8};
  run(fastest, 0, kEmpty, [&](size_t way) { return kSky[way]; });
  constexpr float kCrowd[] = {100, 70, 90};
  run(fastest, kEmpty, kEmpty + 1, [&](size_t way) { return kCrowd[way]; });
  EXPECT_EQ(fastest.turn(kEmpty + 1).best, 1U);
}

TEST(FastestWay, IsNotLedAstrayByOneTask) {
  Fastest fastest(kAll, 0);
  run(fastest, 0, 400, [](size_t way) { return way == 0 ? 1.0F : 1.4F; });
  fastest.took({1.6F, 1.4F, 1.4F});  // held up by another program
  EXPECT_EQ(fastest.turn(401).best, 0U);
}

}  // namespace
}  // namespace sobb::test
