// SPDX-License-Identifier: Apache-2.0
#include "builder/wide/least_cost_cut.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace sobb {
namespace {

// Finds the place after the last pair below a node. Pairs lie depth first.
uint32_t pairs_end(const Topology& topology, const TopologyNode& root) {
  const TopologyNode* node = &root;
  uint32_t end = root.first;
  while (!node->is_leaf) {
    end = node->first + 1;
    const TopologyNode& right = topology.child(*node, 1);
    node = right.is_leaf ? &topology.child(*node, 0) : &right;
  }
  return end;
}

}  // namespace

LeastCostCut::LeastCostCut(const Topology& topology, uint32_t width, uint64_t subtree_limit,
                           const Scheduler& scheduler, std::pmr::memory_resource& memory)
    : topology_(topology), width_(width), costs_(topology.pairs().size(), memory) {
  const double area = topology.root().box.half_area();
  scale_ = area > 0 ? 1 / area : 1;
  if (topology.root().is_leaf) return;
  std::pmr::vector<const TopologyNode*> top({&topology.root()}, &memory);
  std::pmr::vector<const TopologyNode*> subtrees(&memory);
  for (size_t i = 0; i < top.size(); ++i) {
    for (int side = 0; side < 2; ++side) {
      const TopologyNode& child = topology.child(*top[i], side);
      if (!child.is_leaf) (child.count > subtree_limit ? top : subtrees).push_back(&child);
    }
  }
  scheduler.for_each(subtrees.size(), [&](uint64_t i) { solve_subtree(*subtrees[i]); });
  for (size_t i = top.size(); i-- > 0;) solve(*top[i]);
}

const LeastCostCut::Costs& LeastCostCut::costs_of(const TopologyNode& node) const {
  static constexpr Costs kNothing{};
  return node.is_leaf ? kNothing : costs_[node.first];
}

// Goes from the last pair to the first, since children come after their parents.
void LeastCostCut::solve_subtree(const TopologyNode& root) {
  for (uint32_t at = pairs_end(topology_, root); at-- > root.first;) {
    for (const TopologyNode& node : topology_.pairs()[at].child) {
      if (!node.is_leaf) solve(node);
    }
  }
  solve(root);
}

void LeastCostCut::solve(const TopologyNode& node) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Costs& left = costs_of(topology_.child(node, 0));
  // right[kMaxWidth - 1 + i] is C(right, i), infinite for i < 1.
  float right[2 * kMaxWidth];
  std::fill_n(right, kMaxWidth, kInfinity);
  std::copy_n(costs_of(topology_.child(node, 1)).of, kMaxWidth, right + kMaxWidth);
  float shared_out[kMaxWidth];
  std::fill_n(shared_out, kMaxWidth, kInfinity);
  for (uint32_t j = 0; j + 1 < kMaxWidth; ++j) {
    for (uint32_t i = 0; i < kMaxWidth; ++i) {
      shared_out[i] = std::min(shared_out[i], left.of[j] + right[kMaxWidth + i - j - 1]);
    }
  }
  float least = static_cast<float>(node.box.half_area() * scale_) + shared_out[width_ - 1];
  Costs& costs = costs_[node.first];
  costs.of[0] = least;
  for (uint32_t i = 1; i < kMaxWidth; ++i) {
    least = std::min(least, shared_out[i]);
    costs.of[i] = least;
  }
}

uint32_t LeastCostCut::children(const TopologyNode& node,
                                const TopologyNode* child[kMaxWidth]) const {
  uint32_t count = 0;
  if (node.is_leaf) {
    child[count++] = &node;
    return count;
  }
  share(node, width_, child, count);
  return count;
}

// Appends the roots of a node's subtree as the cheapest forest of at most `trees` trees.
void LeastCostCut::gather(const TopologyNode& node, uint32_t trees,
                          const TopologyNode* child[kMaxWidth], uint32_t& count) const {
  const Costs& known = costs_of(node);
  while (trees > 1 && !(known.of[trees - 1] < known.of[trees - 2])) --trees;
  if (trees == 1) {
    child[count++] = &node;
  } else {
    share(node, trees, child, count);
  }
}

// Appends the roots of the cheapest forest whose trees a node's two children share.
void LeastCostCut::share(const TopologyNode& node, uint32_t trees,
                         const TopologyNode* child[kMaxWidth], uint32_t& count) const {
  const TopologyNode& left = topology_.child(node, 0);
  const TopologyNode& right = topology_.child(node, 1);
  uint32_t best = 1;
  float least = std::numeric_limits<float>::infinity();
  for (uint32_t j = 1; j < trees; ++j) {
    const float cost = costs_of(left).of[j - 1] + costs_of(right).of[trees - j - 1];
    if (cost < least) {
      least = cost;
      best = j;
    }
  }
  gather(left, best, child, count);
  gather(right, trees - best, child, count);
}

}  // namespace sobb
