// SPDX-License-Identifier: Apache-2.0
#include "study/binary/binary_tree.h"

namespace sobb::study {
namespace {

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

BinaryTree cut(const BinaryTree& tree, const std::vector<bool>& leaf) {
  BinaryTree result{tree.references, {}};
  append_cut(tree, leaf, 0, result.nodes);
  return result;
}

}  // namespace sobb::study
