// SPDX-License-Identifier: Apache-2.0
// Stopwatch measures the seconds that a piece of work takes.
#pragma once

#include <ctime>

namespace sobb::bench {

/// One thread is measured in processor time of the process: other programs on the machine disturb
/// it least, and it counts every thread that a callee might start. Several threads are measured on
/// the wall clock.
class Stopwatch {
 public:
  explicit Stopwatch(unsigned threads)
      : clock_(threads == 1 ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC) {}

  template <typename Work>
  double seconds_of(const Work& work) const {
    const double start = now();
    work();
    return now() - start;
  }

 private:
  double now() const {
    timespec time{};
    clock_gettime(clock_, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  clockid_t clock_;
};

}  // namespace sobb::bench
