// SPDX-License-Identifier: Apache-2.0
// The binary hierarchy over the triangles' boxes along the axes of a frame. It says which triangles
// lie together; volumes come later.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "base/memory.h"
#include "base/progress.h"
#include "base/scheduler.h"
#include "builder/array.h"
#include "builder/topology/box.h"
#include "sobb/sobb.h"

namespace sobb {

inline constexpr uint32_t kMaxLeafReferences = 8;

struct TopologyNode {
  Box box;
  uint32_t first;       // a leaf's first reference, an inner node's pair of children
  uint32_t count : 31;  // references below it; of an inner node 2^31 - 1 at most
  uint32_t is_leaf : 1;
};

// Siblings, side by side in a cache line.
struct alignas(64) NodePair {
  TopologyNode child[2];

  uint32_t count() const {  // of the node above
    return static_cast<uint32_t>(
        std::min<uint64_t>(uint64_t{child[0].count} + child[1].count, INT32_MAX));
  }
};
static_assert(sizeof(NodePair) == 64);

// What lies in leaves: triangles, by rising index within a leaf. Where a spatial split cut one, the
// box of the part that is meant.
struct References {
  std::span<const uint32_t> primitives;
  std::span<const Box> boxes;  // none where all are whole triangles

  References part(uint64_t first, uint64_t count) const {
    return {primitives.subspan(first, count), boxes.empty() ? boxes : boxes.subspan(first, count)};
  }
};

// Pairs lie depth first: what is below a node is one range, parents before children.
struct BinaryNodes {
  TopologyNode root{};
  Array<NodePair> pairs;
  Array<uint32_t> primitives;  // with gaps between leaves where spatial splits left room
  Array<Box> boxes;            // likewise; none without spatial splits
};

// Low quality is made by Embree's builder, the others by the library's own.
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
  References references() const { return {nodes_.primitives, nodes_.boxes}; }

 private:
  BinaryNodes nodes_;
};

}  // namespace sobb
