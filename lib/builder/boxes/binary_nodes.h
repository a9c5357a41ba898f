// SPDX-License-Identifier: Apache-2.0
// The nodes of a binary hierarchy of boxes, and the references in its leaves.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "builder/array.h"
#include "builder/boxes/references.h"

namespace sobb {

struct TopologyNode {
  Box box;
  uint32_t first;       // a leaf's first reference, an inner node's pair of children
  uint32_t count : 31;  // references below it; an inner node's stays at 2^31 - 1 beyond that
  uint32_t is_leaf : 1;
};

// Two siblings, side by side in a cache line.
struct alignas(64) NodePair {
  TopologyNode child[2];

  uint32_t count() const {  // of the parent
    return static_cast<uint32_t>(
        std::min<uint64_t>(uint64_t{child[0].count} + child[1].count, INT32_MAX));
  }
};
static_assert(sizeof(NodePair) == 64);

// A whole hierarchy. Pairs lie depth first: all that is below a node is one range of them, and
// parents come before their children.
struct BinaryNodes {
  TopologyNode root{};
  Array<NodePair> pairs;
  // The references, as struct References describes them. Spatial splits leave gaps between the
  // leaves, which no node names.
  Array<uint32_t> primitives;
  Array<Box> cuts;

  References references() const { return {primitives, cuts}; }
};

}  // namespace sobb
