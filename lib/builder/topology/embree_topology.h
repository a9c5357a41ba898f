// SPDX-License-Identifier: Apache-2.0
// Low quality: Embree's builder sorts the triangles in Morton order and halves them.
#pragma once

#include "builder/topology/topology.h"

namespace sobb {

// Progress and errors as Topology states.
BinaryNodes embree_topology(const Mesh& mesh, const Scheduler& scheduler, Memory& memory,
                            Progress& progress, double progress_end, const Frame& frame);

}  // namespace sobb
