// SPDX-License-Identifier: Apache-2.0
// The choice among ways to trace, by what tasks are said to have taken.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

#include "trace/fastest_way.h"

namespace sobb::test {
namespace {

constexpr size_t kWays = 3;
using Fastest = FastestWay<kWays>;

// Tasks in their order, whose ways take what `time` says of one. Returns how often each way was the
// task's, or one that it compared.
struct Uses {
  uint64_t best[kWays] = {};
  uint64_t compared[kWays] = {};
};
template <class Time>
Uses run(Fastest& fastest, uint64_t begin, uint64_t end, const Time& time) {
  Uses uses;
  for (uint64_t task = begin; task < end; ++task) {
    const Fastest::Turn turn = fastest.turn(task);
    ++uses.best[turn.best];
    float times[kWays] = {};
    for (size_t way = 0; way < kWays; ++way) {
      if ((turn.compared >> way & 1) == 0) continue;
      ++uses.compared[way];
      times[way] = time(way);
    }
    if (turn.compared != 0) fastest.took(turn, times);
  }
  return uses;
}

TEST(FastestWay, BeginsWithTheOneAskedFor) {
  for (size_t first = 0; first < kWays; ++first) {
    Fastest fastest(first);
    const Fastest::Turn turn = fastest.turn(0);
    EXPECT_EQ(turn.best, first);
    EXPECT_EQ(turn.compared, 0U) << "the first task is not like the others";
  }
}

TEST(FastestWay, ComparesAllThen) {
  Fastest fastest(2);
  EXPECT_EQ(fastest.turn(1).compared, 0b111U);
  EXPECT_EQ(fastest.turn(3).compared, 0U);
  EXPECT_EQ(fastest.turn(Fastest::kTasksAComparison).compared, 0b111U);
  EXPECT_EQ(fastest.turn(Fastest::kTasksAComparison + 1).compared, 0U);
}

TEST(FastestWay, KeepsToTheFastest) {
  constexpr uint64_t kTasks = 4 * Fastest::kTasksAnotherChance;
  for (size_t first = 0; first < kWays; ++first) {
    for (size_t faster = 0; faster < kWays; ++faster) {
      Fastest fastest(first);
      const Uses uses =
          run(fastest, 0, kTasks, [&](size_t way) { return way == faster ? 1.0F : 1.1F; });
      EXPECT_EQ(uses.best[faster], first == faster ? kTasks : kTasks - 2);
    }
  }
}

TEST(FastestWay, TriesTheHopelessInFewerTasks) {
  constexpr uint64_t kTasks = 64 * Fastest::kTasksAnotherChance;
  Fastest fastest(0);
  constexpr float kTimes[] = {1, 1.1F, 3};
  const Uses uses = run(fastest, 0, kTasks, [&](size_t way) { return kTimes[way]; });
  EXPECT_GE(uses.compared[1], kTasks / Fastest::kTasksAComparison);
  EXPECT_GE(uses.compared[2], kTasks / Fastest::kTasksAnotherChance - 1);
  EXPECT_LE(uses.compared[2], kTasks / Fastest::kTasksAnotherChance + 2);
}

TEST(FastestWay, FollowsRaysThatChange) {
  constexpr uint64_t kTasks = 8 * Fastest::kTasksAnotherChance;
  for (size_t then = 0; then < 2; ++then) {
    Fastest fastest(0);
    run(fastest, 0, kTasks, [&](size_t way) { return way == then ? 1.0F : 3.0F; });
    const Uses uses =
        run(fastest, kTasks, 2 * kTasks, [&](size_t way) { return way == 1 - then ? 1.0F : 3.0F; });
    EXPECT_GE(uses.best[1 - then], kTasks - Fastest::kTasksAnotherChance);
  }
}

// Rays that miss all say little: where those after them cost more, the others are tried again soon.
TEST(FastestWay, IsNotBoundByRaysThatCostNothing) {
  Fastest fastest(0);
  constexpr uint64_t kEmpty = 4 * Fastest::kTasksAnotherChance;
  constexpr float kSky[] = {1, 4, 8};
  run(fastest, 0, kEmpty, [&](size_t way) { return kSky[way]; });
  constexpr float kCrowd[] = {100, 70, 90};
  const Uses uses = run(fastest, kEmpty + 1, kEmpty + 1 + 4 * Fastest::kTasksAComparison,
                        [&](size_t way) { return kCrowd[way]; });
  EXPECT_GE(uses.best[1], 2 * Fastest::kTasksAComparison);
}

TEST(FastestWay, IsNotLedAstrayByOneTask) {
  Fastest fastest(0);
  constexpr uint64_t kTasks = 8 * Fastest::kTasksAnotherChance;
  run(fastest, 0, kTasks + 1, [](size_t way) { return way == 0 ? 1.0F : 1.4F; });
  const Fastest::Turn held_up = fastest.turn(kTasks + Fastest::kTasksAnotherChance);
  ASSERT_EQ(held_up.compared, 0b111U);
  fastest.took(held_up, {1.6F, 1.4F, 1.4F});
  EXPECT_EQ(fastest.turn(kTasks + 1).best, 0U);
}

}  // namespace
}  // namespace sobb::test
