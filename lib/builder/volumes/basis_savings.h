// SPDX-License-Identifier: Apache-2.0
// BasisSavings tells by a sample of its nodes whether a hierarchy gains by directions other than
// the frame's.
#pragma once

#include "base/memory.h"
#include "base/scheduler.h"
#include "builder/volumes/node_bounder.h"
#include "builder/wide/wide_topology.h"

namespace sobb {

// Returns whether bases off the frame save enough to be worth choosing. `bounder` chooses bases for
// some small subtrees; in scenes that gain nothing, all other nodes are spared that time.
bool other_directions_pay(const NodeBounder& bounder, const WideTopology& wide,
                          const Scheduler& scheduler, Memory& memory);

}  // namespace sobb
