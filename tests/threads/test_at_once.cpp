// SPDX-License-Identifier: Apache-2.0
// Everything at once: one hierarchy, and one pool of the host's, used from many threads while
// others build, save, open and release.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <string>
#include <thread>

#include "capi/handles.h"
#include "format/temporary_folder.h"
#include "support/more_threads.h"
#include "support/thread_pool.h"

namespace sobb::test {
namespace {

constexpr uint32_t kQualities[] = {SOBB_QUALITY_LOW, SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH};
constexpr int kRounds = 4;

class AtOnce : public testing::Test {
 public:
  // Options for one thread, for TBB's, and for the host's pool, by turns.
  const sobb_scheduler* scheduler_of(int turn) const {
    return turn % 3 == 2 ? &scheduler_ : nullptr;
  }
  static uint32_t threads_of(int turn) { return turn % 3 == 0 ? 1 : 0; }

  void check(bool right) { wrong_ += right ? 0 : 1; }

  void trace_shared(int turn) {
    sobb_trace_options options =
        trace_options(turn % 2 == 0 ? 0 : SOBB_TRACE_COHERENT, threads_of(turn));
    options.scheduler = scheduler_of(turn);
    check(same(trace(shared_, rays_, options), expected_));
    sobb_hit hit;
    check(sobb_intersect1(shared_.get(), rays_.data(), &hit) == SOBB_OK && same(hit, expected_[0]));
  }

  void build_own(int turn) {
    sobb_build_options options =
        build_options(1 + turn % 2, kQualities[turn % 3], threads_of(turn / 3));
    options.scheduler = scheduler_of(turn / 3);
    const HierarchyHandle own = build_soup(soup_, options);
    check(same(trace(own, rays_), expected_));
  }

  void save_and_open(int turn) {
    const std::string path = folder_.path("file" + std::to_string(turn % 2) + ".sobb");
    check(sobb_save(shared_.get(), path.c_str()) == SOBB_OK);
    sobb_open_options options = {};
    options.struct_size = sizeof options;
    options.flags = turn % 2 == 0 ? 0 : SOBB_OPEN_MAP;
    options.threads = threads_of(turn);
    options.scheduler = scheduler_of(turn);
    sobb_hierarchy* handle = nullptr;
    check(sobb_open(path.c_str(), &options, &handle) == SOBB_OK);
    const HierarchyHandle opened(handle);
    check(same(trace(opened, rays_), expected_));
  }

  void share_and_release(int) {
    const HierarchyHandle mine(sobb_retain(shared_.get()));
    check(info_of(mine).triangles == 3000);
    check(bytes_of(mine).size() == info_of(mine).bytes);
  }

  const MoreThreads more_{4};
  ThreadPool pool_{3};
  const sobb_scheduler scheduler_ = pool_.callback();
  const TemporaryFolder folder_;
  const Soup soup_ = random_soup(32, 3000);
  const HierarchyHandle shared_ = build_soup(soup_);
  const std::vector<sobb_ray> rays_ = mixed_rays(soup_, 33, 3000);
  const std::vector<sobb_hit> expected_ = trace(shared_, rays_);
  std::atomic<int> wrong_{0};
};

TEST_F(AtOnce, EveryCallFromEveryThread) {
  std::vector<std::thread> threads;
  int first = 0;
  for (void (AtOnce::*call)(int) :
       {&AtOnce::trace_shared, &AtOnce::trace_shared, &AtOnce::build_own, &AtOnce::save_and_open,
        &AtOnce::save_and_open, &AtOnce::share_and_release}) {
    threads.emplace_back([this, call, first] {
      for (int round = 0; round < kRounds; ++round) (this->*call)(first + round);
    });
    ++first;
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong_, 0);
}

// The last release may be any thread's.
TEST(Release, OfTheLastReferenceByAnyThread) {
  for (int round = 0; round < 50; ++round) {
    sobb_hierarchy* hierarchy = build_soup(random_soup(34, 20)).release();
    std::vector<std::thread> threads;
    threads.reserve(4);
    for (int thread = 0; thread < 4; ++thread) {
      sobb_retain(hierarchy);
      threads.emplace_back([hierarchy] { sobb_release(hierarchy); });
    }
    sobb_release(hierarchy);
    for (std::thread& thread : threads) thread.join();
  }
}

// Each thread has its own message.
TEST(LastErrors, AreTheThreadsOwn) {
  std::vector<std::thread> threads;
  std::atomic<int> wrong{0};
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&wrong, thread] {
      const std::string path = "/nowhere/" + std::to_string(thread) + ".sobb";
      for (int round = 0; round < 100; ++round) {
        sobb_hierarchy* hierarchy = nullptr;
        wrong += sobb_open(path.c_str(), nullptr, &hierarchy) != SOBB_ERROR_FILE_OPEN;
        wrong += std::string(sobb_last_error()).find(path) == std::string::npos;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace sobb::test
