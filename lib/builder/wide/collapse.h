// SPDX-License-Identifier: Apache-2.0
// From binary to wide: which binary nodes become the children of each wide node, and where nodes
// and triangle blocks lie in the file.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "base/scheduler.h"
#include "builder/topology/topology.h"

namespace sobb {

inline constexpr uint32_t kMaxWidth = 8;

// A wide node before it has volumes.
struct WideNode {
  // Of an inner child its node's index, of a leaf its first block's: within the part at first, in
  // the file once laid out.
  uint32_t index[kMaxWidth];
  uint32_t first[kMaxWidth];  // of a leaf, its first reference
  uint8_t count[kMaxWidth];   // of a leaf, its references; of an inner child zero
  uint32_t child_count;

  bool is_leaf(uint32_t child) const { return count[child] > 0; }
};

// Nodes that one thread makes at a time: a subtree, or the top of the hierarchy. Parents come
// before their children.
struct Part {
  std::pmr::vector<WideNode> nodes;
  uint64_t first_node = 0;   // of the file
  uint64_t first_block = 0;  // likewise
  uint64_t block_count = 0;
  uint64_t reference_count = 0;  // in leaves
  uint32_t depth = 0;            // nodes on the longest way down within the part

  explicit Part(std::pmr::memory_resource& memory) : nodes(&memory) {}
};

// The whole hierarchy, over the references of a topology: its top, whose lowest inner children are
// the roots of subtrees. The cut depends on the topology alone, so that all is the same for any
// number of threads.
struct WideTopology {
  References references;
  Part top;
  std::pmr::vector<Part> subtrees;  // in the order of the file
  // By subtree: the node of the top whose child it is, and which child.
  struct Place {
    uint32_t node;
    uint32_t child;
  };
  std::pmr::vector<Place> places;
  uint64_t node_count = 0;
  uint64_t block_count = 0;
  uint64_t reference_count = 0;
  uint32_t depth = 0;

  WideTopology(const References& references, std::pmr::memory_resource& memory)
      : references(references), top(memory), subtrees(&memory), places(&memory) {}
};

// Of the wide nodes that there can be, those of the least cost (least_cost_cut.h). Borrows the
// topology's references, not its nodes.
WideTopology collapse(const Topology& topology, uint32_t width, const Scheduler& scheduler,
                      std::pmr::memory_resource& memory);

}  // namespace sobb
