// SPDX-License-Identifier: Apache-2.0
// From binary to wide: chooses the binary nodes that become the children of each wide node, and
// lays out nodes and triangle blocks.
#pragma once

#include <cstdint>
#include <memory_resource>

#include "base/scheduler.h"
#include "builder/topology/topology.h"
#include "builder/wide/wide_topology.h"

namespace sobb {

// Makes the wide hierarchy of least cost (least_cost_cut.h). It borrows the topology's references,
// not its nodes. Errors: INTERNAL where it is too deep for a file.
WideTopology collapse(const Topology& topology, uint32_t width, const Scheduler& scheduler,
                      std::pmr::memory_resource& memory);

}  // namespace sobb
