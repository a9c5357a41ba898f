// SPDX-License-Identifier: Apache-2.0
// What a run's report says of its circumstances.
#pragma once

#include "bench_volumes/workbench.h"

namespace sobb::bench::volumes {

/// Adds scene, options, rays, versions and processor to Google Benchmark's context.
void add_context(const Workbench& workbench);

}  // namespace sobb::bench::volumes
