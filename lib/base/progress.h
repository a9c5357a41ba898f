// SPDX-License-Identifier: Apache-2.0
// Progress calls the caller's progress callback, from one thread at a time and with values that
// never fall, and passes on its wish to cancel.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>

#include "base/error.h"

namespace sobb {

class Progress {
 public:
  // `callback` may be null. `what` names the work in the message that it was cancelled.
  Progress(int (*callback)(void* user, double fraction), void* user, const char* what = "the build")
      : callback_(callback), user_(user), what_(what) {}

  // Makes all reports to come count within this part of the whole. No other thread may report
  // meanwhile.
  void set_part(double begin, double end) {
    part_begin_ = begin;
    part_end_ = end;
  }

  // Reports that the stage covering [begin, end] of the whole is `fraction` done. Returns false
  // once the caller wants to stop. A report that is behind an earlier one repeats that one.
  bool report(double begin, double end, double fraction) {
    if (callback_ == nullptr) return true;
    const std::scoped_lock lock(mutex_);
    const double done = begin + (end - begin) * fraction;
    reported_ = std::max(reported_, part_begin_ + (part_end_ - part_begin_) * done);
    if (!cancelled_) cancelled_ = callback_(user_, reported_) != 0;
    return !cancelled_;
  }

  // Reports likewise, and throws where the caller wants to stop.
  void check(double begin, double end, double fraction) {
    if (!report(begin, end, fraction)) fail(SOBB_ERROR_CANCELLED, "%s was cancelled", what_);
  }

 private:
  int (*callback_)(void*, double);
  void* user_;
  const char* what_;
  double part_begin_ = 0;
  double part_end_ = 1;
  std::mutex mutex_;
  double reported_ = 0;
  bool cancelled_ = false;
};

// A stage of `total` items, which takes [begin, end] of the whole. Thread-safe.
class ProgressStage {
 public:
  ProgressStage(Progress& progress, double begin, double end, uint64_t total)
      : progress_(progress), begin_(begin), end_(end), total_(total) {}

  // Reports that so many more items are done; throws where the caller wants to stop.
  void advance(uint64_t items) {
    const uint64_t done = done_.fetch_add(items, std::memory_order_relaxed) + items;
    progress_.check(begin_, end_, static_cast<double>(done) / static_cast<double>(total_));
  }

 private:
  Progress& progress_;
  double begin_;
  double end_;
  uint64_t total_;
  std::atomic<uint64_t> done_{0};
};

}  // namespace sobb
