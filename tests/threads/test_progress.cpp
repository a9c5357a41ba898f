// SPDX-License-Identifier: Apache-2.0
// Progress comes from any thread, one at a time; cancelling works from any.
#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <thread>

#include "capi/handles.h"
#include "support/thread_pool.h"

namespace sobb::test {
namespace {

constexpr uint32_t kQualities[] = {SOBB_QUALITY_LOW, SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH};

// What the callback sees. Plain members: the library promises that it calls one thread at a time,
// and ThreadSanitizer sees whether one hands over to the next.
struct Reports {
  double last = 0;
  bool falls = false;
  uint64_t calls = 0;
  std::set<std::thread::id> threads;
  const std::atomic<bool>* cancel = nullptr;
  std::atomic<uint64_t>* seen = nullptr;

  static int note(void* user, double fraction) {
    auto* self = static_cast<Reports*>(user);
    self->falls = self->falls || fraction < self->last;
    self->last = fraction;
    ++self->calls;
    self->threads.insert(std::this_thread::get_id());
    if (self->seen != nullptr) ++*self->seen;
    return self->cancel != nullptr && *self->cancel ? 1 : 0;
  }
};

TEST(Progress, ComesFromSeveralThreadsOneAtATime) {
  ThreadPool pool(3);
  const sobb_scheduler scheduler = pool.callback();
  Reports reports;
  for (int round = 0; round < 20 && reports.threads.size() < 2; ++round) {
    reports.last = 0;
    sobb_build_options options = build_options();
    options.scheduler = &scheduler;
    options.progress = Reports::note;
    options.progress_user = &reports;
    EXPECT_TRUE(build_soup(random_soup(1, 40'000), options));
    EXPECT_FALSE(reports.falls);
    EXPECT_EQ(reports.last, 1);
  }
  EXPECT_GT(reports.threads.size(), 1u);
}

// One thread builds, another cancels while it does.
TEST(Cancel, ComesFromAnotherThread) {
  const Soup soup = random_soup(2, 60'000);
  const sobb_triangles triangles = soup.view();
  ThreadPool pool(3);
  const sobb_scheduler scheduler = pool.callback();
  for (const uint32_t quality : kQualities) {
    for (const bool hosted : {false, true}) {
      std::atomic<bool> cancel{false};
      std::atomic<uint64_t> seen{0};
      Reports reports;
      reports.cancel = &cancel;
      reports.seen = &seen;
      sobb_build_options options = build_options(0, quality, 0);
      options.scheduler = hosted ? &scheduler : nullptr;
      options.progress = Reports::note;
      options.progress_user = &reports;
      std::thread canceller([&] {
        while (seen < 2) std::this_thread::yield();
        cancel = true;
      });
      sobb_hierarchy* hierarchy = untouched_handle();
      const sobb_status status = sobb_build(&triangles, &options, &hierarchy);
      canceller.join();
      // The canceller may be late: then the build went through.
      if (status == SOBB_OK) {
        sobb_release(hierarchy);
      } else {
        EXPECT_EQ(status, SOBB_ERROR_CANCELLED) << sobb_last_error();
        EXPECT_EQ(hierarchy, untouched_handle());
      }
    }
  }
}

}  // namespace
}  // namespace sobb::test
