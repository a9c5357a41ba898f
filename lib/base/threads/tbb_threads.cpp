// SPDX-License-Identifier: Apache-2.0
#include <oneapi/tbb/cache_aligned_allocator.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <list>
#include <mutex>
#include <new>

#include "base/threads/threads.h"
#include "base/threads/workers.h"

namespace sobb {
namespace {

struct Arena {
  explicit Arena(int threads) : size(threads), arena(threads) {}

  int size;
  tbb::task_arena arena;
};

// Arenas and their list take TBB's memory, which belongs to no call and no caller.
using Arenas = std::list<Arena, tbb::cache_aligned_allocator<Arena>>;

// Arenas that nobody is in. They are kept for ever, as many as were ever used at once: an arena
// that is destroyed while a worker is about to leave it is not freed (TBB 2021.8: 30 KB per build).
class IdleArenas {
 public:
  // Makes a list of one arena, of `size` threads.
  Arenas take(int size) {
    Arenas taken;
    {
      const std::scoped_lock lock(mutex_);
      const auto found =
          std::ranges::find_if(arenas_, [&](const Arena& arena) { return arena.size == size; });
      if (found != arenas_.end()) taken.splice(taken.begin(), arenas_, found);
    }
    if (taken.empty()) taken.emplace_back(size);
    return taken;
  }

  void give_back(Arenas& taken) {
    const std::scoped_lock lock(mutex_);
    arenas_.splice(arenas_.begin(), taken);
  }

 private:
  std::mutex mutex_;
  Arenas arenas_;
};

// They are never destroyed: at the process's end TBB may be gone already.
IdleArenas& idle_arenas() {
  alignas(IdleArenas) static std::byte room[sizeof(IdleArenas)];
  static IdleArenas& arenas = *new (room) IdleArenas;
  return arenas;
}

// Borrows an arena, and gives it back however the scope ends.
class BorrowedArena {
 public:
  explicit BorrowedArena(int size) : taken_(idle_arenas().take(size)) {}
  ~BorrowedArena() { idle_arenas().give_back(taken_); }
  BorrowedArena(const BorrowedArena&) = delete;
  BorrowedArena& operator=(const BorrowedArena&) = delete;

  tbb::task_arena& operator*() { return taken_.front().arena; }

 private:
  Arenas taken_;
};

}  // namespace

void run_on_threads(uint32_t threads, uint64_t count, void (*body)(void*, uint64_t),
                    void* context) {
  if (workers_are_gone()) threads = 1;
  if (threads == 1) {
    for (uint64_t i = 0; i < count; ++i) body(context, i);
    return;
  }
  prepare_for_workers();
  const auto run = [&] {
    tbb::parallel_for(uint64_t{0}, count, [&](uint64_t i) { body(context, i); });
  };
  if (threads == 0) return run();
  // TBB never runs more threads than its limit, complains about a larger arena, and allocates all
  // of an arena's slots.
  const size_t limit =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  BorrowedArena arena(static_cast<int>(std::min<size_t>(threads, limit)));
  (*arena).execute(run);
}

}  // namespace sobb
