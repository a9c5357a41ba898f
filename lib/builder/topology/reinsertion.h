// SPDX-License-Identifier: Apache-2.0
// A binary hierarchy improved by moving subtrees to better places (D. Meister, J. Bittner,
// "Parallel Reinsertion for Bounding Volume Hierarchy Optimization", 2018).
#pragma once

#include "base/memory.h"
#include "base/progress.h"
#include "base/scheduler.h"
#include "builder/topology/topology.h"

namespace sobb {

// In each round this share of the nodes, those with the largest boxes, look for a better place.
struct ReinsertionEffort {
  uint32_t rounds;
  double share;
};

// Lowers the sum of the inner nodes' areas; leaves stay as they are. Pairs lie depth first before
// and after. The result is the same for any number of threads. `stage` has one item per round.
void reinsert(BinaryNodes& nodes, const ReinsertionEffort& effort, const Scheduler& scheduler,
              Memory& memory, ProgressStage& stage);

}  // namespace sobb
