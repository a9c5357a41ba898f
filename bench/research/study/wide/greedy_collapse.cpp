// SPDX-License-Identifier: Apache-2.0
#include "study/wide/greedy_collapse.h"

namespace sobb::study {

WideCut collapse_greedily(const BinaryTree& tree, const std::vector<float>& areas, uint32_t width) {
  WideCut cut(tree.nodes.size(), Role::kInside);
  cut[0] = Role::kWide;
  std::vector<uint32_t> children;  // in the tree's order, which breaks ties
  for (uint32_t root = 0; root < tree.nodes.size(); ++root) {
    if (cut[root] != Role::kWide) continue;
    children.assign(tree.nodes[root].child, tree.nodes[root].child + 2);
    while (children.size() < width) {
      auto widest = children.end();
      for (auto at = children.begin(); at != children.end(); ++at) {
        if (tree.nodes[*at].is_leaf()) continue;
        if (widest == children.end() || areas[*at] > areas[*widest]) widest = at;
      }
      if (widest == children.end()) break;
      const BinaryNode& opened = tree.nodes[*widest];
      *widest = opened.child[0];
      children.insert(widest + 1, opened.child[1]);
    }
    for (const uint32_t child : children) {
      cut[child] = tree.nodes[child].is_leaf() ? Role::kLeaf : Role::kWide;
    }
  }
  return cut;
}

}  // namespace sobb::study
