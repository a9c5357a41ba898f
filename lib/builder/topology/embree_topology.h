// SPDX-License-Identifier: Apache-2.0
// The binary hierarchy by Embree's builder, in Morton order.
#pragma once

#include "builder/topology/topology.h"

namespace sobb {

// As Topology has it.
BinaryNodes embree_topology(const Mesh& mesh, const Scheduler& scheduler, Memory& memory,
                            Progress& progress, double progress_end, const Frame& frame);

}  // namespace sobb
