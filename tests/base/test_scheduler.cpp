// SPDX-License-Identifier: Apache-2.0
// Scheduler: every index once, on TBB, on a caller's pool and serially; exceptions.
#include "base/scheduler.h"

#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "support/more_threads.h"
#include "support/thread_pool.h"

namespace sobb {
namespace {

// Runs `check` with every kind of scheduler.
template <class Check>
void with_each_scheduler(const Check& check) {
  const test::MoreThreads more(4);
  for (const uint32_t threads : {0, 1, 2, 3}) {
    SCOPED_TRACE("threads " + std::to_string(threads));
    check(Scheduler(threads, nullptr));
  }
  SCOPED_TRACE("callback");
  test::ThreadPool pool(3);
  const sobb_scheduler callback = pool.callback();
  check(Scheduler(0, &callback));
}

TEST(Scheduler, RunsEveryIndexOnce) {
  with_each_scheduler([](const Scheduler& scheduler) {
    for (const uint64_t count : {0, 1, 2, 1000}) {
      std::vector<std::atomic<int>> runs(count);
      scheduler.for_each(count, [&](uint64_t i) { ++runs[i]; });
      for (uint64_t i = 0; i < count; ++i) EXPECT_EQ(runs[i], 1) << i << " of " << count;
    }
  });
}

TEST(Scheduler, RangesCoverAndDependOnCountAndGrainAlone) {
  using Range = std::pair<uint64_t, uint64_t>;
  with_each_scheduler([](const Scheduler& scheduler) {
    std::mutex mutex;
    std::set<Range> ranges;
    scheduler.for_ranges(10, 4, [&](uint64_t begin, uint64_t end) {
      const std::scoped_lock lock(mutex);
      ranges.emplace(begin, end);
    });
    EXPECT_EQ(ranges, (std::set<Range>{{0, 4}, {4, 8}, {8, 10}}));
    scheduler.for_ranges(0, 4, [](uint64_t, uint64_t) { FAIL() << "a range of nothing"; });
  });
}

TEST(Scheduler, RethrowsTheExceptionOfTheLowestIndexAfterAllBelowHaveRun) {
  with_each_scheduler([](const Scheduler& scheduler) {
    std::atomic<int> runs{0};
    try {
      scheduler.for_each(100, [&](uint64_t i) {
        if (i <= 7) ++runs;
        if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
      });
      FAIL() << "no exception came";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "7");
    }
    EXPECT_EQ(runs, 8);
  });
}

TEST(Scheduler, BodiesRunUnderTheDefaultControlWord) {
  constexpr unsigned kFlushToZero = 0x8000;
  with_each_scheduler([](const Scheduler& scheduler) {
    const unsigned found = _mm_getcsr();
    _mm_setcsr(found | kFlushToZero);
    std::atomic<int> flushing{0};
    scheduler.for_each(50, [&](uint64_t) {
      if ((_mm_getcsr() & kFlushToZero) != 0) ++flushing;
    });
    EXPECT_EQ(flushing, 0);
    EXPECT_NE(_mm_getcsr() & kFlushToZero, 0u);
    _mm_setcsr(found);
  });
}

TEST(Scheduler, LoopsMayNest) {
  with_each_scheduler([](const Scheduler& scheduler) {
    std::atomic<int> runs{0};
    scheduler.for_each(5, [&](uint64_t) { scheduler.for_each(7, [&](uint64_t) { ++runs; }); });
    EXPECT_EQ(runs, 35);
  });
}

TEST(Scheduler, SerialRunsInOrderOnTheCallingThread) {
  std::vector<uint64_t> order;
  Scheduler(1, nullptr).for_each(5, [&](uint64_t i) { order.push_back(i); });
  EXPECT_EQ(order, (std::vector<uint64_t>{0, 1, 2, 3, 4}));
}

TEST(Scheduler, UsesNoMoreThreadsAtOnceThanAsked) {
  const test::MoreThreads more(4);
  std::atomic<int> running{0};
  std::atomic<int> most{0};
  Scheduler(2, nullptr).for_each(200, [&](uint64_t) {
    const int now = ++running;
    int seen = most;
    while (now > seen && !most.compare_exchange_weak(seen, now)) {
    }
    std::this_thread::yield();
    --running;
  });
  EXPECT_GE(most, 1);
  EXPECT_LE(most, 2);
}

}  // namespace
}  // namespace sobb
