// SPDX-License-Identifier: Apache-2.0
#include "base/scheduler.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <mutex>

#include "base/float_control.h"

namespace sobb {
namespace {

// The exception of the lowest index, kept until the loop has ended.
class FirstException {
 public:
  void run(uint64_t index, const std::function<void(uint64_t)>& body) {
    const FloatControl control;
    try {
      body(index);
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
  std::mutex mutex_;
  std::exception_ptr exception_;
  uint64_t index_ = 0;
};

}  // namespace

Scheduler::Scheduler(uint32_t threads, const sobb_scheduler* callback)
    : threads_(threads), callback_(callback) {}

void Scheduler::for_each(uint64_t count, const std::function<void(uint64_t)>& body) const {
  FirstException first;
  const auto run = [&](uint64_t index) { first.run(index, body); };
  if (callback_ != nullptr) {
    const auto trampoline = [](void* context, uint64_t index) {
      (*static_cast<decltype(run)*>(context))(index);
    };
    callback_->parallel_for(callback_->user, count, trampoline,
                            const_cast<void*>(static_cast<const void*>(&run)));
  } else if (threads_ == 1 || count <= 1) {
    for (uint64_t i = 0; i < count; ++i) run(i);
  } else {
    within_arena([&] { tbb::parallel_for(uint64_t{0}, count, run); });
  }
  first.rethrow();
}

void Scheduler::for_ranges(uint64_t count, uint64_t grain,
                           const std::function<void(uint64_t, uint64_t)>& body) const {
  for_each((count + grain - 1) / grain, [&](uint64_t range) {
    body(range * grain, std::min(count, (range + 1) * grain));
  });
}

void Scheduler::within_arena(const std::function<void()>& body) const {
  const bool serial = callback_ != nullptr || threads_ == 1;
  if (!serial && threads_ == 0) {
    body();
    return;
  }
  tbb::task_arena arena(serial ? 1 : static_cast<int>(threads_));
  arena.execute(body);
}

}  // namespace sobb
