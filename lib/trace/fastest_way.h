// SPDX-License-Identifier: Apache-2.0
// The fastest of several ways to trace an array of rays, told by the clock while it is traced.
//
// What a ray costs differs from task to task by more than from way to way. So the ways are compared
// within a task, over rays that are neighbours: most of them go the way that is best so far, some
// each of the others.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <mutex>

namespace sobb {

// Of one array, whose tasks of rays are numbered. Thread-safe.
template <size_t kWays>
class FastestWay {
 public:
  // One task in so many compares the ways, and more of the first ones. Odd: a picture's row of
  // tiles mostly is an even number of tasks, and its left side not like its right one.
  static constexpr uint64_t kTasksAComparison = 17;
  // A way that takes so many times as long as the best is tried in fewer.
  static constexpr float kHopeless = 1.5F;
  static constexpr uint64_t kTasksAnotherChance = 4 * kTasksAComparison;

  // What a task does.
  struct Turn {
    size_t best;        // the way for its rays, or for most of them
    uint32_t compared;  // a bit for each way that has some, where ways are compared, or 0
  };

  // `first` is the best until some task has told otherwise.
  explicit FastestWay(size_t first) : best_(first) {}

  Turn turn(uint64_t task) {
    Turn turn{best_.load(std::memory_order_relaxed), 0};
    // Not the first one: its memory and the caches are cold.
    if (task == 0 || (task % kTasksAComparison != 0 && !std::has_single_bit(task))) return turn;
    const std::lock_guard lock(mutex_);
    for (size_t way = 0; way < kWays; ++way) {
      const bool hopeless = time_[way] > kHopeless * time_[turn.best];
      if (!hopeless || task % kTasksAnotherChance == 0) turn.compared |= 1U << way;
    }
    return turn;
  }

  // What a ray took by each way that had some.
  void took(const Turn& turn, const float (&time)[kWays]) {
    const std::lock_guard lock(mutex_);
    for (size_t way = 0; way < kWays; ++way) {
      if ((turn.compared >> way & 1) != 0) time_[way] = time_[way] / 2 + time[way];
    }
    best_.store(static_cast<size_t>(std::min_element(time_, time_ + kWays) - time_),
                std::memory_order_relaxed);
  }

 private:
  std::atomic<size_t> best_;
  std::mutex mutex_;
  float time_[kWays] = {};  // of all comparisons, each halved with every later one
};

}  // namespace sobb
