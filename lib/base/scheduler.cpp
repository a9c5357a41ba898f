// SPDX-License-Identifier: Apache-2.0
#include "base/scheduler.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <exception>
#include <mutex>

#include "base/float_control.h"

namespace sobb {
namespace {

// A loop under way: its body, and the exception of the lowest index until the loop has ended.
class Loop {
 public:
  Loop(void (*body)(void*, uint64_t), void* context) : body_(body), context_(context) {}

  void run(uint64_t index) noexcept {
    const FloatControl control;
    try {
      body_(context_, index);
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (!exception_ || index < index_) {
        exception_ = std::current_exception();
        index_ = index;
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
  uint64_t index_ = 0;
};

}  // namespace

void Scheduler::run(uint64_t count, void (*body)(void*, uint64_t), void* context) const {
  Loop loop(body, context);
  if (callback_ != nullptr) {
    const auto run_one = [](void* of, uint64_t index) { static_cast<Loop*>(of)->run(index); };
    callback_->parallel_for(callback_->user, count, run_one, &loop);
  } else if (threads_ == 1 || count <= 1) {
    for (uint64_t i = 0; i < count; ++i) loop.run(i);
  } else {
    within_arena([&] { tbb::parallel_for(uint64_t{0}, count, [&](uint64_t i) { loop.run(i); }); });
  }
  loop.rethrow();
}

void Scheduler::run_in_arena(void (*body)(void*), void* context) const {
  const bool serial = callback_ != nullptr || threads_ == 1;
  if (!serial && threads_ == 0) {
    body(context);
    return;
  }
  // TBB never runs more than its limit, complains of a larger arena, and allocates all its slots.
  const size_t limit =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  tbb::task_arena arena(serial ? 1 : static_cast<int>(std::min<size_t>(threads_, limit)));
  arena.execute([&] { body(context); });
}

}  // namespace sobb
