// SPDX-License-Identifier: Apache-2.0
// Finds the fastest of several modes to trace an array of rays, by the clock, while it is traced.
//
// What a ray costs differs from task to task by more than from mode to mode. So the modes are
// compared within a task, over rays from all over it (dealt_rays.h): most of them are traced in the
// mode that is best so far, some in each of the others, fewer in modes that are far behind.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <mutex>

namespace sobb {

// Serves one array, whose tasks of rays are numbered. Thread-safe.
template <size_t kModes>
class FastestMode {
 public:
  // One task in so many compares the modes, and of the first ones those whose numbers are powers of
  // four. It is odd, since a picture's row of tiles is mostly an even number of tasks, and its left
  // side not like its right.
  static constexpr uint64_t kTasksPerComparison = 17;
  // A mode is far behind from so many times on what the best takes.
  static constexpr float kFarBehind = 1.5F;

  // What a task does.
  struct Turn {
    size_t best;      // the mode for its rays, or for most of them
    bool compares;    // whether the other modes get some
    uint32_t behind;  // one bit per mode that is far behind
  };

  // `modes` has one bit per mode that exists; `first` is the best until some task has shown
  // otherwise.
  FastestMode(uint32_t modes, size_t first) : modes_(modes), best_(first) {}

  bool has(size_t mode) const { return (modes_ >> mode & 1) != 0; }

  Turn turn(uint64_t task) {
    Turn turn{best_.load(std::memory_order_relaxed), false, 0};
    // The first task compares nothing: its memory and the caches are cold.
    turn.compares = task != 0 && (task % kTasksPerComparison == 0 || is_power_of_4(task));
    if (!turn.compares) return turn;
    const std::lock_guard lock(mutex_);
    for (size_t mode = 0; mode < kModes; ++mode) {
      if (time_[mode] > kFarBehind * time_[turn.best]) turn.behind |= 1U << mode;
    }
    return turn;
  }

  // Reports what a ray took in each mode, in a task that compared them.
  void took(const float (&time)[kModes]) {
    const std::lock_guard lock(mutex_);
    size_t best = best_.load(std::memory_order_relaxed);
    for (size_t mode = 0; mode < kModes; ++mode) time_[mode] = time_[mode] / 2 + time[mode];
    for (size_t mode = 0; mode < kModes; ++mode) {
      if (has(mode) && time_[mode] < time_[best]) best = mode;
    }
    best_.store(best, std::memory_order_relaxed);
  }

 private:
  static constexpr bool is_power_of_4(uint64_t n) {
    return std::has_single_bit(n) && std::countr_zero(n) % 2 == 0;
  }

  uint32_t modes_;
  std::atomic<size_t> best_;
  std::mutex mutex_;
  float time_[kModes] = {};  // of all comparisons, each halved with every later one
};

}  // namespace sobb
