// SPDX-License-Identifier: Apache-2.0
// Subject is one method in one layout: a hierarchy, with what is counted before the rows are timed.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bench_volumes/options.h"
#include "bench_volumes/ray_groups.h"
#include "volumes/hierarchy.h"

namespace sobb::bench::volumes {

/// What a ray tests, as means over a group, and how long its pass took.
struct Work {
  double nodes = 0;
  double volumes = 0;
  double triangles = 0;
  double seconds = 0;
};

struct Subject {
  study::ConvertSettings settings;
  study::Hierarchy hierarchy;
  study::Areas areas;
  std::array<Work, kGroups> work{};

  /// METHOD/LAYOUT[/STRATEGY], which ends its rows' names.
  std::string name() const;
};

std::string layout_name(uint32_t width);

/// The settings of every method, in the paper's order, with the strategies that the options name.
std::vector<study::ConvertSettings> settings_of(const Options& options, uint32_t width);

}  // namespace sobb::bench::volumes
