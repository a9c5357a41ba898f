// SPDX-License-Identifier: Apache-2.0
// What stands behind lib/base/tbb_threads.h in the ThreadSanitizer build: loops run on threads that
// the sanitizer can follow, and libraries that use TBB by themselves run on the calling thread.
#include "base/tbb_threads.h"

#include <oneapi/tbb/task_arena.h>

#include <mutex>

#include "support/thread_pool.h"

namespace sobb {

void run_on_tbb(uint32_t threads, uint64_t count, void (*body)(void*, uint64_t), void* context) {
  static test::ThreadPool pool(7);
  pool.run(threads, count, body, context);
}

// One at a time: what Embree guards by spin locks of its own, the sanitizer takes for a race.
void run_in_tbb_arena(uint32_t, void (*body)(void*), void* context) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  tbb::task_arena(1).execute([&] { body(context); });
}

}  // namespace sobb
