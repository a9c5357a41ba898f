// SPDX-License-Identifier: Apache-2.0
// A binary hierarchy as an array, whoever built it: what leaves and wide nodes are chosen from.
#pragma once

#include <cstdint>
#include <vector>

#include "builder/topology/topology.h"

namespace sobb::study {

// A triangle in a leaf.
struct Reference {
  uint32_t primitive;
};

struct BinaryNode {
  uint32_t child[2];  // indices of nodes; both 0 for a leaf
  uint32_t first;     // of the references below it
  uint32_t count;

  bool is_leaf() const { return child[0] == 0; }
};

struct BinaryTree {
  std::vector<Reference> references;  // in the order of the leaves
  std::vector<BinaryNode> nodes;      // a node, all below its first child, all below its second
};

BinaryTree flatten(const Topology& topology);

// The same tree with `leaf` of its nodes as leaves: what lies below them is left out.
BinaryTree cut(const BinaryTree& tree, const std::vector<bool>& leaf);

}  // namespace sobb::study
