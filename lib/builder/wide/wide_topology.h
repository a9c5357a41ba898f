// SPDX-License-Identifier: Apache-2.0
// A wide hierarchy before it has volumes: which references are in which leaves, which leaves in
// which nodes, and where nodes and triangle blocks lie in the file.
//
// The room `builder/wide` makes it and walks it: least_cost_cut chooses the binary nodes that
// become children, collapse lays them out, bottom_up.h walks from the leaves to the root. It knows
// `builder/topology`; `builder/volumes` takes the hierarchy from here.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "builder/boxes/references.h"

namespace sobb {

inline constexpr uint32_t kMaxWidth = 8;

struct WideNode {
  // Where each child lies: an inner child's node, a leaf's first triangle block. collapse() first
  // counts both within the treelet, and from the file's first ones once all is laid out.
  uint32_t index[kMaxWidth];
  uint32_t first[kMaxWidth];  // a leaf's first reference
  uint8_t count[kMaxWidth];   // a leaf's references; 0 for an inner child
  uint32_t child_count;

  bool is_leaf(uint32_t child) const { return count[child] > 0; }
};

// Connected nodes that one thread makes and walks: a whole subtree, or the top of the hierarchy.
// They are next to each other in the file, parents before their children.
struct Treelet {
  std::pmr::vector<WideNode> nodes;
  uint64_t first_node = 0;   // in the file
  uint64_t first_block = 0;  // in the file
  uint64_t block_count = 0;
  uint64_t reference_count = 0;  // in the treelet's leaves
  uint32_t depth = 0;            // nodes on the longest way down within the treelet

  explicit Treelet(std::pmr::memory_resource& memory) : nodes(&memory) {}
};

// The whole hierarchy: its top, whose lowest inner children are the roots of the subtrees. The cut
// between them depends on the topology alone, so that the hierarchy is the same for any number of
// threads.
struct WideTopology {
  References references;  // borrowed
  Treelet top;
  std::pmr::vector<Treelet> subtrees;  // in the order of the file
  // For each subtree, which child of which node of the top it is; in the order of nodes and
  // children.
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

}  // namespace sobb
