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

/// Builds and conversions of a large scene take longer than a cell has; passes are what is
/// compared.
inline constexpr int kFewestBuilds = 1;
inline constexpr int kFewestPasses = 3;

/// `fewest` to 9, as the cell's time allows; where nine take less, each is of several passes.
inline Repetitions repetitions(double cell_seconds, double pass_seconds, int fewest) {
  constexpr double kMost = 9, kMostPasses = 1e6;
  const double fit = cell_seconds / std::max(pass_seconds, 1e-9);
  const double count = std::clamp<double>(fit, fewest, kMost);
  return {static_cast<int>(count), static_cast<int64_t>(std::clamp(fit / kMost, 1.0, kMostPasses))};
}

}  // namespace sobb::bench::volumes
