// SPDX-License-Identifier: Apache-2.0
#include "study/wide/shared_collapse.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "builder/boxes/references.h"
#include "builder/wide/collapse.h"
#include "study/binary/sah_costs.h"

namespace sobb::study {
namespace {

using Costs = std::array<float, kMaxWidth + 1>;  // of a forest of at most i roots, at [i]

class Collapse {
 public:
  Collapse(const BinaryTree& tree, const AreaMeasure& measure, Leaves leaves)
      : tree_(tree),
        measure_(measure),
        leaves_(leaves),
        kdops_(measure.kdops(tree)),
        areas_(measure.areas(SOBB_VOLUME_SOBB, tree)),
        wide_(tree.nodes.size()) {
    for (auto at = static_cast<uint32_t>(tree.nodes.size()); at-- > 0;) {
      if (!tree.nodes[at].is_leaf()) weigh(at);
    }
  }

  WideCut cut() {
    cut_.assign(tree_.nodes.size(), Role::kInside);
    make_wide(0);
    return std::move(cut_);
  }

 private:
  // A wide node that begins here: the cost of all below it, and its basis.
  struct Wide {
    float cost = std::numeric_limits<float>::infinity();
    uint16_t basis = kAxesBasis;
  };

  bool may_be_leaf(uint32_t at) const {
    const BinaryNode& node = tree_.nodes[at];
    return node.is_leaf() || (leaves_ == Leaves::kChosen && node.count <= kMaxLeafReferences);
  }

  // What visiting a node as a child costs per area of its volume.
  float cost_per_area(uint32_t at) const {
    const BinaryNode& node = tree_.nodes[at];
    const float leaf = triangles_cost(node.count);
    if (node.is_leaf()) return leaf;
    const float wide = kWideNodeCost + (areas_[at] > 0 ? wide_[at].cost / areas_[at] : 0);
    return may_be_leaf(at) ? std::min(leaf, wide) : wide;
  }

  float leaf_cost(uint32_t at, uint16_t basis) const {
    return may_be_leaf(at)
               ? measure_.area_in(basis, kdops_[at]) * triangles_cost(tree_.nodes[at].count)
               : std::numeric_limits<float>::infinity();
  }

  float root_cost(uint32_t at, uint16_t basis) const {
    const float leaf = leaf_cost(at, basis);
    if (tree_.nodes[at].is_leaf()) return leaf;
    return std::min(leaf, kWideNodeCost * measure_.area_in(basis, kdops_[at]) + wide_[at].cost);
  }

  // D(n, i) for two forests, and how many roots the first gets.
  static std::pair<float, uint32_t> share(const Costs& first, const Costs& second, uint32_t roots) {
    std::pair<float, uint32_t> best{std::numeric_limits<float>::infinity(), 0};
    for (uint32_t k = 1; k < roots; ++k) {
      best = std::min(best, {first[k] + second[roots - k], k});
    }
    return best;
  }

  Costs forest(uint32_t at, uint32_t most_roots, uint16_t basis) const {
    Costs costs;
    costs.fill(root_cost(at, basis));
    if (tree_.nodes[at].is_leaf() || most_roots == 1) return costs;
    const Costs first = forest(tree_.nodes[at].child[0], most_roots - 1, basis);
    const Costs second = forest(tree_.nodes[at].child[1], most_roots - 1, basis);
    for (uint32_t i = 2; i <= most_roots; ++i) {
      costs[i] = std::min(costs[i - 1], share(first, second, i).first);
    }
    return costs;
  }

  // The cost of a wide node's children. The node itself cannot be the only root.
  float children_cost(uint32_t at, uint16_t basis) const {
    const auto& child = tree_.nodes[at].child;
    return share(forest(child[0], kMaxWidth - 1, basis), forest(child[1], kMaxWidth - 1, basis),
                 kMaxWidth)
        .first;
  }

  uint16_t likely_basis(uint32_t at) const {
    std::array<uint32_t, kMaxWidth> child{tree_.nodes[at].child[0], tree_.nodes[at].child[1]};
    size_t count = 2;
    const auto opens_before = [&](uint32_t a, uint32_t b) {
      return tree_.nodes[b].is_leaf() || (!tree_.nodes[a].is_leaf() && areas_[a] >= areas_[b]);
    };
    while (count < kMaxWidth) {
      size_t widest = 0;
      for (size_t i = 1; i < count; ++i) {
        if (!opens_before(child[widest], child[i])) widest = i;
      }
      const BinaryNode& opened = tree_.nodes[child[widest]];
      if (opened.is_leaf()) break;
      child[widest] = opened.child[0];
      child[count++] = opened.child[1];
    }
    std::array<const Kdop*, kMaxWidth> kdops;
    std::array<float, kMaxWidth> weights;
    for (size_t i = 0; i < count; ++i) {
      kdops[i] = &kdops_[child[i]];
      weights[i] = cost_per_area(child[i]);
    }
    return measure_.shared_basis({kdops.data(), count}, weights.data());
  }

  void weigh(uint32_t at) {
    for (const uint16_t basis : {kAxesBasis, likely_basis(at)}) {
      const float cost = children_cost(at, basis);
      if (cost < wide_[at].cost) wide_[at] = {cost, basis};
    }
  }

  void make_wide(uint32_t at) {
    cut_[at] = Role::kWide;
    divide(at, kMaxWidth, wide_[at].basis);
  }

  // Divides what lies below an inner node into `roots` roots.
  void divide(uint32_t at, uint32_t roots, uint16_t basis) {
    const auto& child = tree_.nodes[at].child;
    const uint32_t first =
        share(forest(child[0], roots - 1, basis), forest(child[1], roots - 1, basis), roots).second;
    settle(child[0], first, basis);
    settle(child[1], roots - first, basis);
  }

  void settle(uint32_t at, uint32_t roots, uint16_t basis) {
    const Costs costs = forest(at, roots, basis);
    while (roots > 1 && costs[roots] == costs[roots - 1]) --roots;
    if (roots > 1) {
      divide(at, roots, basis);
    } else if (leaf_cost(at, basis) == costs[1]) {
      cut_[at] = Role::kLeaf;
    } else {
      make_wide(at);
    }
  }

  const BinaryTree& tree_;
  const AreaMeasure& measure_;
  Leaves leaves_;
  std::vector<Kdop> kdops_;
  std::vector<float> areas_;
  std::vector<Wide> wide_;
  WideCut cut_;
};

}  // namespace

WideCut collapse_sharing(const BinaryTree& tree, const AreaMeasure& measure, Leaves leaves) {
  return Collapse(tree, measure, leaves).cut();
}

}  // namespace sobb::study
