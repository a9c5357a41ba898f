// SPDX-License-Identifier: Apache-2.0
#include "base/scheduler.h"

#include <atomic>
#include <exception>
#include <mutex>

#include "base/float_control.h"
#include "base/threads/threads.h"

namespace sobb {
namespace {

// A loop under way: its body, and the exception of the lowest index until the loop has ended.
class Loop {
 public:
  Loop(void (*body)(void*, uint64_t), void* context) : body_(body), context_(context) {}

  // A body above one that failed no longer matters, so that the rest of a long loop ends at once.
  void run(uint64_t index) noexcept {
    if (index > failed_.load(std::memory_order_relaxed)) return;
    const FloatControl control;
    try {
      body_(context_, index);
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (index < failed_.load(std::memory_order_relaxed)) {
        exception_ = std::current_exception();
        failed_.store(index, std::memory_order_relaxed);
      }
    }
  }

  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  void (*body_)(void*, uint64_t);
  void* context_;
  std::mutex mutex_;
  std::exception_ptr exception_;
  std::atomic<uint64_t> failed_{UINT64_MAX};  // the lowest index of which a body threw
};

}  // namespace

void Scheduler::run(uint64_t count, void (*body)(void*, uint64_t), void* context) const {
  Loop loop(body, context);
  const auto run_one = [](void* of, uint64_t index) { static_cast<Loop*>(of)->run(index); };
  if (callback_ != nullptr) {
    callback_->parallel_for(callback_->user, count, run_one, &loop);
  } else if (threads_ == 1 || count <= 1) {
    for (uint64_t i = 0; i < count; ++i) loop.run(i);
  } else {
    run_on_threads(threads_, count, run_one, &loop);
  }
  loop.rethrow();
}

}  // namespace sobb
