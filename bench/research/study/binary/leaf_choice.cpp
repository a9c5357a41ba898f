// SPDX-License-Identifier: Apache-2.0
#include "study/binary/leaf_choice.h"

#include "builder/boxes/references.h"
#include "study/binary/sah_costs.h"

namespace sobb::study {

BinaryTree choose_leaves(const BinaryTree& tree, const std::vector<float>& areas) {
  std::vector<bool> leaf(tree.nodes.size());
  std::vector<float> cost(tree.nodes.size());
  for (size_t at = tree.nodes.size(); at-- > 0;) {
    const BinaryNode& node = tree.nodes[at];
    cost[at] = areas[at] * triangles_cost(node.count);
    if (node.is_leaf()) continue;
    const float inner = kStepCost * areas[at] + cost[node.child[0]] + cost[node.child[1]];
    leaf[at] = node.count <= kMaxLeafReferences && cost[at] <= inner;
    if (!leaf[at]) cost[at] = inner;
  }
  return cut(tree, leaf);
}

}  // namespace sobb::study
