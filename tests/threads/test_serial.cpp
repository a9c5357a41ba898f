// SPDX-License-Identifier: Apache-2.0
// Serial mode starts no thread, and a host's scheduler starts none but its own: not for building,
// not for saving, opening and tracing.
#include <gtest/gtest.h>

#include <mutex>
#include <thread>

#include "capi/handles.h"
#include "format/temporary_folder.h"
#include "support/more_threads.h"
#include "support/thread_pool.h"
#include "threads/process_threads.h"

namespace sobb::test {
namespace {

constexpr uint32_t kQualities[] = {SOBB_QUALITY_LOW, SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH};

// Looks at the process's threads whenever a call asks for memory or reports its progress.
struct Observer {
  ThreadWatch watch;
  std::thread::id caller = std::this_thread::get_id();
  std::mutex mutex;
  uint64_t elsewhere = 0;  // callbacks on another thread than the caller's
  sobb_allocator allocator{this, allocate, deallocate};

  void look() {
    const std::scoped_lock lock(mutex);
    watch.look();
    elsewhere += std::this_thread::get_id() != caller;
  }
  static int progress(void* user, double) {
    static_cast<Observer*>(user)->look();
    return 0;
  }
  static void* allocate(void* user, size_t size, size_t alignment) {
    static_cast<Observer*>(user)->look();
    return ::operator new(size, std::align_val_t(alignment), std::nothrow);
  }
  static void deallocate(void* user, void* pointer, size_t, size_t alignment) {
    static_cast<Observer*>(user)->look();
    ::operator delete(pointer, std::align_val_t(alignment));
  }
};

// Builds, saves, opens and traces with `threads` and `scheduler`, under the eyes of `observer`.
void use_everything(uint32_t quality, uint32_t threads, const sobb_scheduler* scheduler,
                    Observer& observer) {
  const Soup soup = random_soup(1, 40'000);
  sobb_build_options building = build_options(0, quality, threads);
  building.scheduler = scheduler;
  building.allocator = &observer.allocator;
  building.progress = Observer::progress;
  building.progress_user = &observer;
  const HierarchyHandle built = build_soup(soup, building);

  const TemporaryFolder folder;
  const std::string path = folder.path("serial.sobb");
  ASSERT_EQ(sobb_save(built.get(), path.c_str()), SOBB_OK) << sobb_last_error();
  sobb_open_options opening = {};
  opening.struct_size = sizeof opening;
  opening.threads = threads;
  opening.scheduler = scheduler;
  opening.allocator = &observer.allocator;
  sobb_hierarchy* handle = nullptr;
  ASSERT_EQ(sobb_open(path.c_str(), &opening, &handle), SOBB_OK) << sobb_last_error();
  const HierarchyHandle opened(handle);

  sobb_trace_options tracing = trace_options(0, threads);
  tracing.scheduler = scheduler;
  const std::vector<sobb_ray> rays = mixed_rays(soup, 2, 20'000);
  EXPECT_TRUE(same(trace(opened, rays, tracing), trace(built, rays, tracing)));
  observer.look();
}

TEST(Serial, StartsNoThread) {
  const MoreThreads more(8);
  for (const uint32_t quality : kQualities) {
    Observer observer;
    use_everything(quality, 1, nullptr, observer);
    EXPECT_EQ(observer.watch.started(), 0u) << "quality " << quality;
    EXPECT_EQ(observer.elsewhere, 0u) << "quality " << quality;
    EXPECT_GT(observer.watch.looks(), 10u);
  }
}

TEST(HostScheduler, IsAllThatRuns) {
  const MoreThreads more(8);
  ThreadPool pool(3);
  const sobb_scheduler scheduler = pool.callback();
  for (const uint32_t quality : kQualities) {
    Observer observer;  // made when the pool is there
    use_everything(quality, 0, &scheduler, observer);
    EXPECT_EQ(observer.watch.started(), 0u) << "quality " << quality;
    EXPECT_GT(observer.elsewhere, 0u) << "quality " << quality << ": the pool was not used";
  }
}

}  // namespace
}  // namespace sobb::test
