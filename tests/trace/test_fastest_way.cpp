// SPDX-License-Identifier: Apache-2.0
// The choice between two ways to trace, by what tasks are said to have taken.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>

#include "trace/fastest_way.h"

namespace sobb::test {
namespace {

using std::chrono::microseconds;

constexpr uint64_t kRays = 1000;

// Tasks in their order, which take what `cost` says of a way. Returns how many took way 1.
template <class Cost>
uint64_t run(FastestWay& fastest, uint64_t first, uint64_t tasks, const Cost& cost) {
  uint64_t ones = 0;
  for (uint64_t task = first; task < first + tasks; ++task) {
    const size_t way = fastest.of_task(task);
    ones += way;
    fastest.took(way, microseconds(cost(way)), kRays);
  }
  return ones;
}

TEST(FastestWay, TriesBothInTheOrderAskedFor) {
  for (const size_t first : {0, 1}) {
    FastestWay fastest(first);
    EXPECT_EQ(fastest.of_task(0), first);
    EXPECT_EQ(fastest.of_task(1), 1 - first);
    EXPECT_EQ(fastest.of_task(2), first) << "where nothing is known";
    EXPECT_EQ(fastest.of_task(FastestWay::kTasksATry), first);
    EXPECT_EQ(fastest.of_task(FastestWay::kTasksATry + 1), 1 - first);
  }
}

TEST(FastestWay, PrefersNoWayThatHasNotEndedATask) {
  for (const size_t ended : {0, 1}) {
    for (const size_t first : {0, 1}) {
      FastestWay fastest(first);  // of several threads, one is done
      fastest.took(ended, microseconds(100), kRays);
      EXPECT_EQ(fastest.of_task(2), ended);
    }
  }
}

TEST(FastestWay, KeepsToTheFaster) {
  for (const size_t faster : {0, 1}) {
    FastestWay fastest(1 - faster);
    constexpr uint64_t kTasks = 4 * FastestWay::kTasksATry;
    const uint64_t ones =
        run(fastest, 0, kTasks, [&](size_t way) { return way == faster ? 100 : 130; });
    EXPECT_EQ(faster == 1 ? ones : kTasks - ones, kTasks - 4) << "the slower is tried four times";
  }
}

TEST(FastestWay, FollowsRaysThatChange) {
  FastestWay fastest(0);
  run(fastest, 0, 64, [](size_t way) { return way == 0 ? 100 : 300; });
  // From here on the other is the faster: each try brings its time half of the way down.
  run(fastest, 64, 4 * 64, [](size_t way) { return way == 0 ? 300 : 100; });
  EXPECT_EQ(run(fastest, 5 * 64 + 2, 62, [](size_t way) { return way == 0 ? 300 : 100; }), 62U);
}

TEST(FastestWay, ForgivesATaskThatWasHeldUp) {
  FastestWay fastest(0);
  run(fastest, 0, 64, [](size_t way) { return way == 0 ? 100 : 200; });
  fastest.took(0, std::chrono::seconds(10), kRays);
  EXPECT_EQ(fastest.of_task(66), 0U) << "it counts as twice the time at most, half of it new";
}

}  // namespace
}  // namespace sobb::test
