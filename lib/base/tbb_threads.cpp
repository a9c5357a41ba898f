// SPDX-License-Identifier: Apache-2.0
#include "base/tbb_threads.h"

#include <dlfcn.h>
#include <oneapi/tbb/cache_aligned_allocator.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <list>
#include <mutex>
#include <new>

namespace sobb {
namespace {

// Set in the child of a fork whose parent had started workers. The child has none of them, and one
// may have held a lock of TBB's, so the child runs its loops on the calling thread.
std::atomic<bool> workers_are_gone{false};

// Keeps the shared object that has this code, and so TBB below it, in the process for good. TBB's
// workers live on when a loop has ended, and run TBB's code, for a moment also the end of a loop's:
// a host that unloaded the last user of TBB would take the code from under them. They cannot be
// waited for, since the host may use TBB as well.
void stay_loaded() {
  static const char here = 0;
  Dl_info object;
  // A program itself is not found by its name, and nobody unloads it.
  if (dladdr(&here, &object) != 0 && object.dli_fname != nullptr) {
    dlopen(object.dli_fname, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
  }
}

// To be called before TBB may start a worker.
void prepare_for_workers() {
  static std::once_flag prepared;
  std::call_once(prepared, [] {
    stay_loaded();
    pthread_atfork(nullptr, nullptr, [] { workers_are_gone = true; });
  });
}

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

template <class Body>
void within_arena(uint32_t threads, const Body& body) {
  if (workers_are_gone) threads = 1;
  if (threads != 1) prepare_for_workers();
  if (threads == 0) {
    body();
    return;
  }
  // TBB never runs more threads than its limit, complains about a larger arena, and allocates all
  // of an arena's slots.
  const size_t limit =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  BorrowedArena arena(static_cast<int>(std::min<size_t>(threads, limit)));
  (*arena).execute(body);
}

}  // namespace

void run_on_tbb(uint32_t threads, uint64_t count, void (*body)(void*, uint64_t), void* context) {
  if (workers_are_gone) {
    for (uint64_t i = 0; i < count; ++i) body(context, i);
    return;
  }
  within_arena(threads, [&] {
    tbb::parallel_for(uint64_t{0}, count, [&](uint64_t i) { body(context, i); });
  });
}

void run_in_tbb_arena(uint32_t threads, void (*body)(void*), void* context) {
  within_arena(threads, [&] { body(context); });
}

}  // namespace sobb
