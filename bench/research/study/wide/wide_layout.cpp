// SPDX-License-Identifier: Apache-2.0
#include "study/wide/wide_layout.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "format/layout.h"

namespace sobb::study {
namespace {

// The children of a wide node, in the tree's order.
void gather(const BinaryTree& tree, const WideCut& cut, uint32_t node,
            std::vector<uint32_t>& children) {
  for (const uint32_t child : tree.nodes[node].child) {
    if (cut[child] == Role::kInside) {
      gather(tree, cut, child, children);
    } else {
      children.push_back(child);
    }
  }
}

}  // namespace

WideLayout lay_out(const BinaryTree& tree, const WideCut& cut, std::pmr::memory_resource& memory) {
  if (tree.nodes[0].is_leaf()) fail(SOBB_ERROR_INTERNAL, "a hierarchy of one leaf only");
  std::vector<uint32_t> primitives;
  for (const Reference& reference : tree.references) primitives.push_back(reference.primitive);
  const References references{primitives, {}};
  WideLayout layout{std::move(primitives), WideTopology(references, memory), 0, 0};

  Treelet& part = layout.topology.top;
  struct Pending {
    uint32_t root;   // in the tree
    uint32_t index;  // of the wide node
    uint32_t depth;
  };
  std::vector<Pending> stack{{0, 0, 1}};
  part.nodes.resize(1);
  uint64_t depth_sum = 0;
  std::vector<uint32_t> children;
  while (!stack.empty()) {
    const Pending wide_root = stack.back();
    stack.pop_back();
    part.depth = std::max(part.depth, wide_root.depth);
    children.clear();
    gather(tree, cut, wide_root.root, children);
    WideNode wide{};
    for (const uint32_t child : children) {
      const uint32_t i = wide.child_count++;
      if (cut[child] == Role::kLeaf) {
        wide.index[i] = static_cast<uint32_t>(part.block_count);
        wide.first[i] = tree.nodes[child].first;
        wide.count[i] = static_cast<uint8_t>(tree.nodes[child].count);
        part.block_count += blocks_of(tree.nodes[child].count);
        ++layout.leaf_count;
        depth_sum += wide_root.depth;
      } else {
        wide.index[i] = static_cast<uint32_t>(part.nodes.size());
        part.nodes.emplace_back();
      }
    }
    for (uint32_t i = wide.child_count; i-- > 0;) {
      if (cut[children[i]] == Role::kWide) {
        stack.push_back({children[i], wide.index[i], wide_root.depth + 1});
      }
    }
    part.nodes[wide_root.index] = wide;
  }
  if (part.depth > kMaxDepth) {
    fail(SOBB_ERROR_INTERNAL, "a hierarchy of %u nodes deep, more than %u", part.depth, kMaxDepth);
  }
  layout.topology.node_count = part.nodes.size();
  layout.topology.block_count = part.block_count;
  layout.topology.depth = part.depth;
  layout.mean_leaf_depth = static_cast<double>(depth_sum) / static_cast<double>(layout.leaf_count);
  return layout;
}

}  // namespace sobb::study
