// SPDX-License-Identifier: Apache-2.0
// A leaf's k-DOP and its triangle blocks.
#pragma once

#include "bounds/bounds_kernels.h"
#include "builder/mesh.h"
#include "builder/topology/topology.h"
#include "format/layout.h"

namespace sobb {

// The k-DOP of a leaf's triangles, kMaxLeafReferences at most, each clipped to its reference's box
// where a spatial split cut it. `frame` is that of the topology.
void fit_leaf(const Mesh& mesh, const References& leaf, const DirectionTable& directions,
              const float centre[3], const BoundsKernels& kernels, Kdop& kdop,
              const Frame& frame = Frame());

// Writes a leaf's blocks_of(its references) blocks.
void write_blocks(const Mesh& mesh, std::span<const uint32_t> primitives, TriangleBlock* blocks);

}  // namespace sobb
