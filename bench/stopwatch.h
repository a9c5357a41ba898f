// SPDX-License-Identifier: Apache-2.0
// Seconds that a piece of work took.
#pragma once

#include <ctime>

namespace sobb::bench {

/// One thread is measured in processor time of the process, which other programs on the machine
/// disturb least, and which counts every thread that a callee might start; several threads on the
/// wall clock.
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
