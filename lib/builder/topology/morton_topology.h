// SPDX-License-Identifier: Apache-2.0
// Low quality: the cells of a grid, in Morton order, make the top of the hierarchy (C. Lauterbach
// et al., "Fast BVH Construction on GPUs", 2009). Below, nodes are split by the surface area
// heuristic while they are large, and in the middle of their centres from there on.
#pragma once

#include "builder/sah/sah_kernels.h"
#include "builder/topology/topology.h"

namespace sobb {

// Progress and errors as Topology states.
BinaryNodes morton_topology(const Mesh& mesh, const SahKernels& kernels, const Scheduler& scheduler,
                            Memory& memory, Progress& progress, double progress_end,
                            const Frame& frame);

}  // namespace sobb
