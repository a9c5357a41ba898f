// SPDX-License-Identifier: Apache-2.0
// How often a row is repeated, by how long it takes once.
#pragma once

#include <algorithm>
#include <cstdint>

namespace sobb::bench::volumes {

struct Repetitions {
  int count = 1;
  int64_t passes = 1;  // timed together, in each
};

/// 3 to 9, as the cell's time allows; where nine take less, each is of several passes.
inline Repetitions repetitions(double cell_seconds, double pass_seconds) {
  constexpr double kFewest = 3, kMost = 9, kMostPasses = 1e6;
  const double fit = cell_seconds / std::max(pass_seconds, 1e-9);
  const double count = std::clamp(fit, kFewest, kMost);
  return {static_cast<int>(count), static_cast<int64_t>(std::clamp(fit / kMost, 1.0, kMostPasses))};
}

}  // namespace sobb::bench::volumes
