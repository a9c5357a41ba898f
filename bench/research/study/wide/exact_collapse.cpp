// SPDX-License-Identifier: Apache-2.0
#include "study/wide/exact_collapse.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "builder/boxes/references.h"
#include "builder/wide/collapse.h"
#include "study/binary/sah_costs.h"

namespace sobb::study {
namespace {

using Costs = std::array<float, kMaxWidth>;  // C(n, i) at [i]; [0] is unused

class Collapse {
 public:
  Collapse(const BinaryTree& tree, const std::vector<float>& areas, uint32_t width, Leaves leaves)
      : tree_(tree), areas_(areas), width_(width), leaves_(leaves), costs_(tree.nodes.size()) {
    for (auto at = static_cast<uint32_t>(tree.nodes.size()); at-- > 0;) weigh(at);
  }

  WideCut cut() {
    cut_.assign(tree_.nodes.size(), Role::kInside);
    cut_[0] = Role::kWide;
    share(0, width_);
    return std::move(cut_);
  }

 private:
  struct Share {
    float cost = std::numeric_limits<float>::infinity();
    uint32_t left_roots = 0;
  };

  // D(n, i), and the k that attains it.
  Share distribute(uint32_t node, uint32_t roots) const {
    const Costs& left = costs_[tree_.nodes[node].child[0]];
    const Costs& right = costs_[tree_.nodes[node].child[1]];
    Share best;
    for (uint32_t k = 1; k < roots; ++k) {
      const float cost = left[k] + right[roots - k];
      if (cost < best.cost) best = {cost, k};
    }
    return best;
  }

  float leaf_cost(uint32_t at) const {
    const BinaryNode& node = tree_.nodes[at];
    const bool possible = node.is_leaf() || (leaves_ == Leaves::kChosen && at != 0 &&
                                             node.count <= kMaxLeafReferences);
    return possible ? areas_[at] * triangles_cost(node.count)
                    : std::numeric_limits<float>::infinity();
  }

  void weigh(uint32_t at) {
    Costs& cost = costs_[at];
    const float leaf = leaf_cost(at);
    if (tree_.nodes[at].is_leaf()) {
      cost.fill(leaf);
      return;
    }
    cost[1] = std::min(leaf, kWideNodeCost * areas_[at] + distribute(at, width_).cost);
    for (uint32_t i = 2; i < width_; ++i) cost[i] = std::min(distribute(at, i).cost, cost[i - 1]);
  }

  // Divides what lies below an inner node into `roots` roots.
  void share(uint32_t at, uint32_t roots) {
    const uint32_t left = distribute(at, roots).left_roots;
    settle(tree_.nodes[at].child[0], left);
    settle(tree_.nodes[at].child[1], roots - left);
  }

  void settle(uint32_t at, uint32_t roots) {
    while (roots > 1 && costs_[at][roots] == costs_[at][roots - 1]) --roots;
    if (roots > 1) return share(at, roots);
    cut_[at] = leaf_cost(at) == costs_[at][1] ? Role::kLeaf : Role::kWide;
    if (cut_[at] == Role::kWide) share(at, width_);
  }

  const BinaryTree& tree_;
  const std::vector<float>& areas_;
  uint32_t width_;
  Leaves leaves_;
  std::vector<Costs> costs_;
  WideCut cut_;
};

}  // namespace

WideCut collapse_exactly(const BinaryTree& tree, const std::vector<float>& areas, uint32_t width,
                         Leaves leaves) {
  return Collapse(tree, areas, width, leaves).cut();
}

}  // namespace sobb::study
