// SPDX-License-Identifier: Apache-2.0
// Registers the rows with Google Benchmark.
#pragma once

#include "bench_volumes/workbench.h"

namespace sobb::bench::volumes {

/// build/LAYOUT: topology, layout and the AABB's conversion.
void register_build_rows(Workbench& workbench);
/// overhead/METHOD/LAYOUT[/STRATEGY]: a conversion.
void register_overhead_rows(Workbench& workbench);
/// primary/… and secondary/…: a pass over the rays.
void register_trace_rows(Workbench& workbench);

}  // namespace sobb::bench::volumes
