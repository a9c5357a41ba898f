// SPDX-License-Identifier: Apache-2.0
#include "study/binary/binary_tree.h"

namespace sobb::study {
namespace {

uint32_t append(const Topology& topology, const TopologyNode& node, BinaryTree& tree) {
  const auto at = static_cast<uint32_t>(tree.nodes.size());
  const auto first = static_cast<uint32_t>(tree.references.size());
  tree.nodes.push_back({{0, 0}, first, node.count});
  if (node.is_leaf) {
    for (const uint32_t primitive : topology.references().part(node.first, node.count).primitives) {
      tree.references.push_back({primitive});
    }
  } else {
    for (int i = 0; i < 2; ++i) {
      const uint32_t child = append(topology, topology.child(node, i), tree);
      tree.nodes[at].child[i] = child;
    }
  }
  return at;
}

uint32_t append_cut(const BinaryTree& tree, const std::vector<bool>& leaf, uint32_t node,
                    std::vector<BinaryNode>& result) {
  const auto at = static_cast<uint32_t>(result.size());
  result.push_back({{0, 0}, tree.nodes[node].first, tree.nodes[node].count});
  if (!leaf[node] && !tree.nodes[node].is_leaf()) {
    for (int i = 0; i < 2; ++i) {
      const uint32_t child = append_cut(tree, leaf, tree.nodes[node].child[i], result);
      result[at].child[i] = child;
    }
  }
  return at;
}

}  // namespace

BinaryTree flatten(const Topology& topology) {
  BinaryTree tree;
  append(topology, topology.root(), tree);
  return tree;
}

BinaryTree cut(const BinaryTree& tree, const std::vector<bool>& leaf) {
  BinaryTree result{tree.references, {}};
  append_cut(tree, leaf, 0, result.nodes);
  return result;
}

}  // namespace sobb::study
