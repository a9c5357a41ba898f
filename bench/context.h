// SPDX-License-Identifier: Apache-2.0
// The context of a run's report: what was measured, where and with which options.
#pragma once

#include "workbench.h"

namespace sobb::bench {

/// Adds scene, options, versions and processor to Google Benchmark's context.
void add_context(const Workbench& workbench);

}  // namespace sobb::bench
