// SPDX-License-Identifier: Apache-2.0
// BinaryTree is a binary hierarchy as an array, whoever built it. Leaves and wide nodes are chosen
// from it.
#pragma once

#include <cstdint>
#include <vector>

namespace sobb::study {

// A triangle in a leaf.
struct Reference {
  uint32_t primitive;
};

struct BinaryNode {
  uint32_t child[2];  // indices of nodes; both 0 for a leaf
  uint32_t first;     // index of the first reference below it
  uint32_t count;

  bool is_leaf() const { return child[0] == 0; }
};

struct BinaryTree {
  std::vector<Reference> references;  // in the order of the leaves
  std::vector<BinaryNode> nodes;      // depth first: a node, its first child's, its second child's
};

// Copies the tree and makes the nodes marked in `leaf` leaves: what lies below them is left out.
BinaryTree cut(const BinaryTree& tree, const std::vector<bool>& leaf);

}  // namespace sobb::study
