// SPDX-License-Identifier: Apache-2.0
#include "support/thread_pool.h"

#include <atomic>

namespace sobb::test {

struct ThreadPool::Loop {
  void (*body)(void*, uint64_t);
  void* context;
  uint64_t count;
  uint32_t room;  // for workers
  uint32_t inside = 0;
  std::atomic<uint64_t> next{0};

  void run() {
    for (uint64_t i = next++; i < count; i = next++) body(context, i);
  }
};

ThreadPool::ThreadPool(uint32_t workers) {
  for (uint32_t i = 0; i < workers; ++i) threads_.emplace_back([this] { work(); });
}

ThreadPool::~ThreadPool() {
  {
    const std::scoped_lock lock(mutex_);
    ends_ = true;
  }
  opened_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadPool::run(uint32_t threads, uint64_t count, void (*body)(void*, uint64_t),
                     void* context) {
  Loop loop{body, context, count, threads == 0 ? UINT32_MAX : threads - 1};
  {
    const std::scoped_lock lock(mutex_);
    loops_.push_back(&loop);
  }
  opened_.notify_all();
  loop.run();
  std::unique_lock lock(mutex_);
  std::erase(loops_, &loop);
  left_.wait(lock, [&] { return loop.inside == 0; });
}

void ThreadPool::parallel_for(void* user, uint64_t count, void (*body)(void*, uint64_t),
                              void* context) {
  static_cast<ThreadPool*>(user)->run(0, count, body, context);
}

// The latest first: others wait for the loops inside their own.
ThreadPool::Loop* ThreadPool::loop_with_room() const {
  for (auto loop = loops_.rbegin(); loop != loops_.rend(); ++loop) {
    if ((*loop)->room != 0 && (*loop)->next < (*loop)->count) return *loop;
  }
  return nullptr;
}

void ThreadPool::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    Loop* loop = nullptr;
    opened_.wait(lock, [&] { return ends_ || (loop = loop_with_room()) != nullptr; });
    if (loop == nullptr) return;
    --loop->room;
    ++loop->inside;
    lock.unlock();
    loop->run();
    lock.lock();
    ++loop->room;
    --loop->inside;
    left_.notify_all();
  }
}

}  // namespace sobb::test
