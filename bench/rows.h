// SPDX-License-Identifier: Apache-2.0
// Each function registers one kind of rows with Google Benchmark.
#pragma once

#include "register_row.h"
#include "workbench.h"

namespace sobb::bench {

void register_build_rows(Workbench& workbench);
void register_open_rows(Workbench& workbench);
void register_trace_rows(Workbench& workbench);

}  // namespace sobb::bench
