// SPDX-License-Identifier: Apache-2.0
// A subtree, by one thread, depth first. Included once for each Highway target.
#if defined(SOBB_BUILD_SAH_SUBTREE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_BUILD_SAH_SUBTREE_INL_H
#undef SOBB_BUILD_SAH_SUBTREE_INL_H
#else
#define SOBB_BUILD_SAH_SUBTREE_INL_H
#endif

#include "build/sah_bins-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

class SubtreeBuilder {
 public:
  explicit SubtreeBuilder(SahSubtree& subtree) : subtree_(subtree) {}

  void build() {
    subtree_.pairs.reserve(subtree_.node.count);  // so that none moves
    add(subtree_.node, 0, subtree_.depth, subtree_.root);
    subtree_.pairs.shrink_to_fit();
  }

 private:
  // Makes a node of the references of array `from`.
  void add(const SahNode& node, int from, uint32_t depth, TopologyNode& made) {
    made.box = node.box.box();
    Split split;
    Binning binning;
    if (node.count > 1 && depth < kDeepestSplit) {
      binning = make_binning(node.centres, node.count);
      clear(bins_, binning.count);
      bin(subtree_.at[from] + node.begin, node.count, binning, bins_);
      split = find_split(node, bins_, binning.count);
    }
    made.is_leaf =
        node.count <= kMaxLeafReferences &&
        kLeafBlockCost * blocks(node.count) <= kBinaryStepCost + kLeafBlockCost * split.cost;
    if (made.is_leaf) return finish(node, from, made);

    SahNode child[2];
    if (split.axis >= 0) {
      divide(node, from, binning, split, child);
      from = 1 - from;
    } else {
      halve(node, from, child);
    }
    made.first = static_cast<uint32_t>(subtree_.pairs.size());
    NodePair& pair = subtree_.pairs.emplace_back();
    add(child[0], from, depth + 1, pair.child[0]);
    add(child[1], from, depth + 1, pair.child[1]);
    made.count = pair.count();
  }

  void divide(const SahNode& node, int from, const Binning& binning, const Split& split,
              SahNode child[2]) const {
    Centres centres[2] = {Centres::nothing(), Centres::nothing()};
    SahReference* left = subtree_.at[1 - from] + node.begin;
    partition(subtree_.at[from] + node.begin, node.count, binning, split, left,
              left + split.left_count, centres);
    child[0] = {split.box[0], centres[0], node.begin, split.left_count};
    child[1] = {split.box[1], centres[1], node.begin + split.left_count,
                node.count - split.left_count};
  }

  // As they come: where nothing tells the references apart.
  void halve(const SahNode& node, int from, SahNode child[2]) const {
    const uint64_t half = node.count / 2;
    const SahReference* references = subtree_.at[from];
    for (int side = 0; side < 2; ++side) {
      child[side] = {FlatBox::nothing(), Centres::nothing(), node.begin + side * half,
                     side == 0 ? half : node.count - half};
      bound(references + child[side].begin, child[side].count, child[side].box,
            child[side].centres);
    }
  }

  void finish(const SahNode& node, int from, TopologyNode& leaf) const {
    leaf.first = static_cast<uint32_t>(node.begin);
    leaf.count = static_cast<uint32_t>(node.count);
    for (uint64_t i = node.begin; i < node.begin + node.count; ++i) {
      subtree_.primitives[i] = subtree_.at[from][i].primitive;
    }
  }

  SahSubtree& subtree_;
  Bins bins_;
};

void build(SahSubtree& subtree) { SubtreeBuilder(subtree).build(); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
