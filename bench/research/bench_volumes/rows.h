// SPDX-License-Identifier: Apache-2.0
// Each function registers one kind of rows with Google Benchmark.
#pragma once

#include "bench_volumes/workbench.h"

namespace sobb::bench::volumes {

/// build/LAYOUT measures topology, layout and the AABB's conversion.
void register_build_rows(Workbench& workbench);
/// overhead/METHOD/LAYOUT[/STRATEGY] measures a conversion.
void register_overhead_rows(Workbench& workbench);
/// primary/… and secondary/… measure a pass over the rays.
void register_trace_rows(Workbench& workbench);

}  // namespace sobb::bench::volumes
