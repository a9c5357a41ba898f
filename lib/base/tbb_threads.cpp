// SPDX-License-Identifier: Apache-2.0
#include "base/tbb_threads.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

namespace sobb {
namespace {

template <class Body>
void within_arena(uint32_t threads, const Body& body) {
  if (threads == 0) {
    body();
    return;
  }
  // TBB never runs more than its limit, complains of a larger arena, and allocates all its slots.
  const size_t limit =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  tbb::task_arena arena(static_cast<int>(std::min<size_t>(threads, limit)));
  arena.execute(body);
}

}  // namespace

void run_on_tbb(uint32_t threads, uint64_t count, void (*body)(void*, uint64_t), void* context) {
  within_arena(threads, [&] {
    tbb::parallel_for(uint64_t{0}, count, [&](uint64_t i) { body(context, i); });
  });
}

void run_in_tbb_arena(uint32_t threads, void (*body)(void*), void* context) {
  within_arena(threads, [&] { body(context); });
}

}  // namespace sobb
