// SPDX-License-Identifier: Apache-2.0
// The binary hierarchy over the triangles' boxes along the axes of a frame. It says which triangles
// lie together; volumes come later.
//
// The room `builder/topology` chooses a binary hierarchy: morton_topology makes low quality,
// topology_builder the others, both with the kernels of `builder/sah`; reinsertion improves what
// the latter made. It knows `builder/boxes` and `builder/sah`; `builder/wide` takes the hierarchy
// from here.
#pragma once

#include <cstdint>
#include <span>

#include "base/memory.h"
#include "base/progress.h"
#include "base/scheduler.h"
#include "builder/boxes/binary_nodes.h"
#include "builder/boxes/frame.h"
#include "sobb/sobb.h"

namespace sobb {

// A whole binary hierarchy of the quality asked for.
class Topology {
 public:
  // Progress runs from 0 to `progress_end`. Errors: OUT_OF_MEMORY, MEMORY_LIMIT, CANCELLED,
  // INTERNAL. The same for any number of threads and any instruction set.
  Topology(const Mesh& mesh, sobb_quality quality, const Scheduler& scheduler, Memory& memory,
           Progress& progress, double progress_end, const Frame& frame = Frame(),
           sobb_isa isa = SOBB_ISA_BEST);

  const TopologyNode& root() const { return nodes_.root; }
  const TopologyNode& child(const TopologyNode& node, int side) const {
    return nodes_.pairs[node.first].child[side];
  }
  std::span<const NodePair> pairs() const { return nodes_.pairs; }
  References references() const { return nodes_.references(); }

 private:
  BinaryNodes nodes_;
};

}  // namespace sobb
