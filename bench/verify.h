// SPDX-License-Identifier: Apache-2.0
// verify() checks after the run that what was timed found the right hits.
#pragma once

#include <ostream>

#include "workbench.h"

namespace sobb::bench {

/// Traces every ray set that the run made with every hierarchy that it built, by all calls, and
/// compares the results bit by bit; says for how many rays Embree finds another result. Returns
/// false, with the first difference written to @p log, where two of ours differ.
bool verify(Workbench& workbench, std::ostream& log);

}  // namespace sobb::bench
