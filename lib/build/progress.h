// SPDX-License-Identifier: Apache-2.0
// The caller's progress callback: one thread at a time, never falling, and its wish to cancel.
#pragma once

#include <atomic>
#include <mutex>

#include "base/error.h"

namespace sobb {

class Progress {
 public:
  Progress(int (*callback)(void* user, double fraction), void* user)
      : callback_(callback), user_(user) {}

  // Reports that the stage covering [begin, end] of the whole is `fraction` done. Returns false
  // once the caller wants to stop. A report behind another is dropped.
  bool report(double begin, double end, double fraction) {
    if (callback_ == nullptr) return true;
    const std::scoped_lock lock(mutex_);
    const double now = begin + (end - begin) * fraction;
    if (!cancelled_ && now >= reported_) {
      reported_ = now;
      cancelled_ = callback_(user_, now) != 0;
    }
    return !cancelled_;
  }

  // The same, throwing where the caller wants to stop.
  void check(double begin, double end, double fraction) {
    if (!report(begin, end, fraction)) fail(SOBB_ERROR_CANCELLED, "the build was cancelled");
  }

 private:
  int (*callback_)(void*, double);
  void* user_;
  std::mutex mutex_;
  double reported_ = 0;
  bool cancelled_ = false;
};

}  // namespace sobb
