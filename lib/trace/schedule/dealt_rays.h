// SPDX-License-Identifier: Apache-2.0
// Deals the rays of a task out among modes to trace them: each mode gets some from all over the
// task, so that the modes can be compared. What rays cost differs from one end of a task to the
// other by more than modes do. Neighbours stay together: the rays are dealt out in runs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "trace/trace.h"

namespace sobb {

// Filled anew for each task.
template <class Result>
class DealtRays {
 public:
  // Rays per run: no fewer than a packet has.
  static constexpr uint32_t kRun = 64;
  static constexpr uint32_t kRuns = kBatchRays / kRun;

  // Deals out `kBatchRays` rays: to each mode as many runs as `runs` says, which are `kRuns` in
  // all.
  void deal(const sobb_ray* rays, const uint32_t (&runs)[kTraceModes]) {
    uint32_t begin = 0;
    for (size_t mode = 0; mode < kTraceModes; ++mode) {
      begin_[mode] = begin;
      begin += runs[mode];
    }
    uint32_t dealt[kTraceModes] = {};
    for (uint32_t run = 0; run < kRuns; ++run) {
      // The mode whose share is the furthest behind gets the run.
      size_t next = 0;
      for (size_t mode = 1; mode < kTraceModes; ++mode) {
        const auto due = [&](size_t of) {
          return static_cast<int>(runs[of] * (run + 1)) - static_cast<int>(dealt[of] * kRuns);
        };
        if (due(mode) > due(next)) next = mode;
      }
      place_[run] = begin_[next] + dealt[next]++;
      std::copy_n(rays + size_t{run} * kRun, kRun, rays_ + size_t{place_[run]} * kRun);
    }
  }

  const sobb_ray* rays(size_t mode) const { return rays_ + size_t{begin_[mode]} * kRun; }
  Result* results(size_t mode) { return results_ + size_t{begin_[mode]} * kRun; }

  // The results in the order of the rays that were dealt.
  void collect(Result* results) const {
    for (uint32_t run = 0; run < kRuns; ++run) {
      std::copy_n(results_ + size_t{place_[run]} * kRun, kRun, results + size_t{run} * kRun);
    }
  }

 private:
  uint32_t begin_[kTraceModes];  // the first place of each mode
  uint32_t place_[kRuns];        // where each run is
  sobb_ray rays_[kBatchRays];
  Result results_[kBatchRays];
};

}  // namespace sobb
