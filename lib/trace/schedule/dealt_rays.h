// SPDX-License-Identifier: Apache-2.0
// Rays of a task dealt out among ways to trace them: each way gets some from all over the task, so
// that the ways can be compared. What rays cost differs from one end of a task to the other by more
// than ways do. Neighbours stay together: the rays are dealt out in runs.
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
  // Rays of a run: no fewer than a packet has.
  static constexpr uint32_t kRun = 64;
  static constexpr uint32_t kRuns = kBatchRays / kRun;

  // Deals out `kBatchRays` rays: to each way as many runs as `runs` says, which are `kRuns` in all.
  void deal(const sobb_ray* rays, const uint32_t (&runs)[kArrayWays]) {
    uint32_t begin = 0;
    for (size_t way = 0; way < kArrayWays; ++way) {
      begin_[way] = begin;
      begin += runs[way];
    }
    uint32_t dealt[kArrayWays] = {};
    for (uint32_t run = 0; run < kRuns; ++run) {
      // Whose share is the furthest behind.
      size_t next = 0;
      for (size_t way = 1; way < kArrayWays; ++way) {
        const auto due = [&](size_t of) {
          return static_cast<int>(runs[of] * (run + 1)) - static_cast<int>(dealt[of] * kRuns);
        };
        if (due(way) > due(next)) next = way;
      }
      place_[run] = begin_[next] + dealt[next]++;
      std::copy_n(rays + size_t{run} * kRun, kRun, rays_ + size_t{place_[run]} * kRun);
    }
  }

  const sobb_ray* rays(size_t way) const { return rays_ + size_t{begin_[way]} * kRun; }
  Result* results(size_t way) { return results_ + size_t{begin_[way]} * kRun; }

  // The results in the order of the rays that were dealt.
  void collect(Result* results) const {
    for (uint32_t run = 0; run < kRuns; ++run) {
      std::copy_n(results_ + size_t{place_[run]} * kRun, kRun, results + size_t{run} * kRun);
    }
  }

 private:
  uint32_t begin_[kArrayWays];  // the first place of each way
  uint32_t place_[kRuns];       // where each run is
  sobb_ray rays_[kBatchRays];
  Result results_[kBatchRays];
};

}  // namespace sobb
