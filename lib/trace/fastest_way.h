// SPDX-License-Identifier: Apache-2.0
// Which of two ways to trace an array's rays is the faster: that depends on the rays, the scene's
// size and the machine's memory, so it is told by the time that each took of late. Results do not
// depend on it.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace sobb {

// Of one array, whose tasks of rays are numbered. Thread-safe.
class FastestWay {
 public:
  static constexpr size_t kWays = 2;
  // Of so many tasks, each way is tried by one.
  static constexpr uint64_t kTasksATry = 64;

  // `first` is the way to begin with.
  explicit FastestWay(size_t first) : first_(first) {}

  // The way for a task.
  size_t of_task(uint64_t task) const {
    const uint64_t turn = task % kTasksATry;
    if (turn < kWays) return (first_ + turn) % kWays;
    const float times[kWays] = {time_[0].load(std::memory_order_relaxed),
                                time_[1].load(std::memory_order_relaxed)};
    if (times[0] == times[1]) return first_;
    return times[0] < times[1] ? 0 : 1;
  }

  // What a task of some rays took.
  void took(size_t way, std::chrono::steady_clock::duration time, uint64_t rays) {
    const float now = std::chrono::duration<float>(time).count() / static_cast<float>(rays);
    const float before = time_[way].load(std::memory_order_relaxed);
    // A task that another program held up counts as one of twice the time at most.
    const float next = std::isinf(before) ? now : (before + std::min(now, 2 * before)) / 2;
    time_[way].store(next, std::memory_order_relaxed);
  }

 private:
  size_t first_;
  // Seconds a ray. A way that no task has ended yet in, on several threads, is not preferred.
  std::atomic<float> time_[kWays] = {INFINITY, INFINITY};
};

}  // namespace sobb
