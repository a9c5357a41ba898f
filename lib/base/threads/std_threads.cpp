// SPDX-License-Identifier: Apache-2.0
// A pool of the standard library's threads, for the whole process.
#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>

#include "base/threads/threads.h"
#include "base/threads/workers.h"

namespace sobb {
namespace {

constexpr uint64_t kMostWorkers = 255;

// A loop under way, on the stack of the thread that called it.
struct OpenLoop {
  void (*body)(void*, uint64_t);
  void* context;
  uint64_t count;
  uint64_t room;        // for workers
  uint64_t inside = 0;  // workers
  OpenLoop* outer = nullptr;
  std::atomic<uint64_t> next{0};

  void run() {
    for (uint64_t i = next++; i < count; i = next++) body(context, i);
  }
};

class Pool {
 public:
  void run(OpenLoop& loop) {
    {
      const std::scoped_lock lock(mutex_);
      start_workers(loop.room);
      loop.outer = loops_;
      loops_ = &loop;
    }
    opened_.notify_all();
    loop.run();
    std::unique_lock lock(mutex_);
    OpenLoop** link = &loops_;
    while (*link != &loop) link = &(*link)->outer;
    *link = loop.outer;
    left_.wait(lock, [&] { return loop.inside == 0; });
  }

 private:
  // A system that refuses a thread leaves the loop to those that there are.
  void start_workers(uint64_t count) {
    try {
      for (; workers_ < count; ++workers_) std::thread([this] { work(); }).detach();
    } catch (const std::system_error&) {
    }
  }

  // The latest loop first: those before it may wait for it inside of their bodies.
  OpenLoop* loop_with_room() const {
    OpenLoop* loop = loops_;
    while (loop != nullptr && (loop->room == 0 || loop->next >= loop->count)) loop = loop->outer;
    return loop;
  }

  [[noreturn]] void work() {
    std::unique_lock lock(mutex_);
    while (true) {
      OpenLoop* loop = nullptr;
      opened_.wait(lock, [&] { return (loop = loop_with_room()) != nullptr; });
      --loop->room;
      ++loop->inside;
      lock.unlock();
      loop->run();
      lock.lock();
      ++loop->room;
      if (--loop->inside == 0) left_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable opened_;  // a loop
  std::condition_variable left_;    // by its last worker: a loop
  OpenLoop* loops_ = nullptr;
  uint64_t workers_ = 0;
};

// The pool is never destroyed, since its workers live as long as the process.
Pool& pool() {
  alignas(Pool) static std::byte room[sizeof(Pool)];
  static Pool& pool = *new (room) Pool;
  return pool;
}

}  // namespace

void run_on_threads(uint32_t threads, uint64_t count, void (*body)(void*, uint64_t),
                    void* context) {
  const uint64_t wanted = threads == 0 ? std::thread::hardware_concurrency() : threads;
  const uint64_t workers = std::min({wanted, count, kMostWorkers + 1});
  OpenLoop loop{body, context, count, workers == 0 ? 0 : workers - 1};
  if (loop.room == 0 || workers_are_gone()) return loop.run();
  prepare_for_workers();
  pool().run(loop);
}

}  // namespace sobb
