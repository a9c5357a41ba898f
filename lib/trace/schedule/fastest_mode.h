// SPDX-License-Identifier: Apache-2.0
// The fastest of several ways to trace an array of rays, told by the clock while it is traced.
//
// What a ray costs differs from task to task by more than from way to way. So the ways are compared
// within a task, over rays from all over it (dealt_rays.h): most of them go the way that is best so
// far, some each of the others, fewer by ways that are far behind.
#pragma once

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
  // One task in so many compares the ways, and of the first ones the powers of four. Odd: a
  // picture's row of tiles mostly is an even number of tasks, and its left side not like its right.
  static constexpr uint64_t kTasksAComparison = 17;
  // Times as long as the best takes, from which on a way is far behind.
  static constexpr float kFarBehind = 1.5F;

  // What a task does.
  struct Turn {
    size_t best;      // the way for its rays, or for most of them
    bool compares;    // whether the other ways get some
    uint32_t behind;  // a bit for each that is far behind
  };

  // `ways` has a bit for each that there is; `first` is the best until some task has told
  // otherwise.
  FastestWay(uint32_t ways, size_t first) : ways_(ways), best_(first) {}

  bool has(size_t way) const { return (ways_ >> way & 1) != 0; }

  Turn turn(uint64_t task) {
    Turn turn{best_.load(std::memory_order_relaxed), false, 0};
    // Not the first one: its memory and the caches are cold.
    turn.compares = task != 0 && (task % kTasksAComparison == 0 || is_power_of_4(task));
    if (!turn.compares) return turn;
    const std::lock_guard lock(mutex_);
    for (size_t way = 0; way < kWays; ++way) {
      if (time_[way] > kFarBehind * time_[turn.best]) turn.behind |= 1U << way;
    }
    return turn;
  }

  // What a ray took by each way in a task that compared them.
  void took(const float (&time)[kWays]) {
    const std::lock_guard lock(mutex_);
    size_t best = best_.load(std::memory_order_relaxed);
    for (size_t way = 0; way < kWays; ++way) time_[way] = time_[way] / 2 + time[way];
    for (size_t way = 0; way < kWays; ++way) {
      if (has(way) && time_[way] < time_[best]) best = way;
    }
    best_.store(best, std::memory_order_relaxed);
  }

 private:
  static constexpr bool is_power_of_4(uint64_t n) {
    return std::has_single_bit(n) && std::countr_zero(n) % 2 == 0;
  }

  uint32_t ways_;
  std::atomic<size_t> best_;
  std::mutex mutex_;
  float time_[kWays] = {};  // of all comparisons, each halved with every later one
};

}  // namespace sobb
