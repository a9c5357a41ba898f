// SPDX-License-Identifier: Apache-2.0
// repetitions() says how often a row is repeated, by how long it takes once.
#pragma once

#include <algorithm>
#include <cstdint>

namespace sobb::bench::volumes {

struct Repetitions {
  int count = 1;
  int64_t passes = 1;  // in each, timed together
};

/// Builds and conversions of a large scene take longer than a row has time for. Passes are what
/// runs are compared by, so they are repeated in any case.
inline constexpr int kFewestBuilds = 1;
inline constexpr int kFewestPasses = 3;

/// `fewest` to 9 repetitions, as the row's time allows; where nine take less, each has several
/// passes.
inline Repetitions repetitions(double cell_seconds, double pass_seconds, int fewest) {
  constexpr double kMost = 9, kMostPasses = 1e6;
  const double fit = cell_seconds / std::max(pass_seconds, 1e-9);
  const double count = std::clamp<double>(fit, fewest, kMost);
  return {static_cast<int>(count), static_cast<int64_t>(std::clamp(fit / kMost, 1.0, kMostPasses))};
}

}  // namespace sobb::bench::volumes
