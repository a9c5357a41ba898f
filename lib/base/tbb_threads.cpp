// SPDX-License-Identifier: Apache-2.0
#include "base/tbb_threads.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <utility>

namespace sobb {
namespace {

struct Arena {
  explicit Arena(int threads) : size(threads), arena(threads) {}

  int size;
  tbb::task_arena arena;
  std::unique_ptr<Arena> next;
};

// Arenas that nobody is in. They are kept for ever, as many as were ever used at once: an arena
// that is destroyed while a worker is about to leave it is not freed (TBB 2021.8: 30 KB a build).
class IdleArenas {
 public:
  // One of `size` threads.
  std::unique_ptr<Arena> take(int size) {
    {
      const std::scoped_lock lock(mutex_);
      std::unique_ptr<Arena>* link = &first_;
      while (*link && (*link)->size != size) link = &(*link)->next;
      if (*link) {
        std::unique_ptr<Arena> found = std::move(*link);
        *link = std::move(found->next);
        return found;
      }
    }
    return std::make_unique<Arena>(size);
  }

  void give_back(std::unique_ptr<Arena> arena) {
    const std::scoped_lock lock(mutex_);
    arena->next = std::move(first_);
    first_ = std::move(arena);
  }

 private:
  std::mutex mutex_;
  std::unique_ptr<Arena> first_;
};

// Never destroyed: at the process's end TBB may have gone before.
IdleArenas& idle_arenas() {
  static IdleArenas& arenas = *new IdleArenas;
  return arenas;
}

template <class Body>
void within_arena(uint32_t threads, const Body& body) {
  if (threads == 0) {
    body();
    return;
  }
  // TBB never runs more than its limit, complains of a larger arena, and allocates all its slots.
  const size_t limit =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  std::unique_ptr<Arena> arena =
      idle_arenas().take(static_cast<int>(std::min<size_t>(threads, limit)));
  arena->arena.execute(body);
  idle_arenas().give_back(std::move(arena));
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
