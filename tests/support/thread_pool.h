// SPDX-License-Identifier: Apache-2.0
// A host's thread pool, of std::thread: what sobb_scheduler is for, and what sanitizers understand.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#include "sobb/sobb.h"

namespace sobb::test {

// Thread-safe; loops may nest. The caller of a loop works in it too.
class ThreadPool {
 public:
  explicit ThreadPool(uint32_t workers);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  // body(context, i) once for each i < count, on at most `threads` threads; 0 for all.
  void run(uint32_t threads, uint64_t count, void (*body)(void*, uint64_t), void* context);

  // For the options; the pool has to outlive the calls made with it.
  sobb_scheduler callback() { return {this, parallel_for}; }

 private:
  struct Loop;

  static void parallel_for(void* user, uint64_t count, void (*body)(void*, uint64_t),
                           void* context);
  void work();
  Loop* loop_with_room() const;

  std::mutex mutex_;
  std::condition_variable opened_;  // a loop, or the pool's end
  std::condition_variable left_;    // by a worker: a loop
  std::vector<Loop*> loops_;
  bool ends_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace sobb::test
