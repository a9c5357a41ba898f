// SPDX-License-Identifier: Apache-2.0
// One thread builds a subtree, depth first.
#if defined(SOBB_BUILDER_SAH_SAH_SUBTREE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_BUILDER_SAH_SAH_SUBTREE_INL_H
#undef SOBB_BUILDER_SAH_SAH_SUBTREE_INL_H
#else
#define SOBB_BUILDER_SAH_SAH_SUBTREE_INL_H
#endif

#include "builder/sah/sah_kinds-inl.h"
#include "builder/sah/sah_middle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

class SubtreeBuilder {
 public:
  explicit SubtreeBuilder(SahSubtree& subtree) : subtree_(subtree) {}

  void build() {
    const SahNode& node = subtree_.node;
    subtree_.pairs.reserve(node.count + node.room);  // so that none moves
    add(node, 0, subtree_.depth, subtree_.root);
    // Not shrink_to_fit(), which takes a refused allocation for success.
    auto& pairs = subtree_.pairs;
    std::pmr::vector<NodePair>(pairs.begin(), pairs.end(), pairs.get_allocator()).swap(pairs);
  }

 private:
  // Makes a node of the references of array `from`.
  void add(const SahNode& node, int from, uint32_t depth, TopologyNode& made) {
    if (node.count <= subtree_.middle_count) return add_by_middle(node, from, depth, made);
    made.box = node.extent.box.box();
    Split split;
    if (node.count > 1 && depth < kDeepestSplit && !is_one_block(node, from)) {
      split = find_best(node, from);
    }
    made.is_leaf = node.count <= kMaxLeafReferences && is_leaf_cheaper(node.count, split.cost);
    if (made.is_leaf) return finish(node, from, made);

    SahNode child[2];
    if (split.axis >= 0) {
      divide(node, from, split, child);
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

  // Makes a node likewise, with splits in the middle. A block of triangles is not split further.
  void add_by_middle(const SahNode& node, int from, uint32_t depth, TopologyNode& made) {
    made.box = node.extent.box.box();
    made.is_leaf = blocks_of(node.count) == 1;
    if (made.is_leaf) return finish(node, from, made);
    SahNode child[2];
    if (depth < kDeepestSplit && has_middle(node)) {
      const SahReference* references = subtree_.at[from] + node.begin;
      from = 1 - from;
      split_in_middle(references, node, subtree_.at[from] + node.begin, child);
    } else {
      halve(node, from, child);
    }
    // The references of both sides lie side by side, so that they can still become one leaf.
    made.is_leaf =
        node.count <= kMaxLeafReferences && is_leaf_cheaper(node.count, split_cost(node, child));
    if (made.is_leaf) return finish(node, from, made);
    made.first = static_cast<uint32_t>(subtree_.pairs.size());
    NodePair& pair = subtree_.pairs.emplace_back();
    add_by_middle(child[0], from, depth + 1, pair.child[0]);
    add_by_middle(child[1], from, depth + 1, pair.child[1]);
    made.count = pair.count();
  }

  static float split_cost(const SahNode& node, const SahNode child[2]) {
    const Areas area(node.extent.box);
    return area(child[0].extent.box) * blocks(child[0].count) +
           area(child[1].extent.box) * blocks(child[1].count);
  }

  static bool is_leaf_cheaper(uint64_t count, float split_cost) {
    return kLeafBlockCost * blocks(count) <= kBinaryStepCost + kLeafBlockCost * split_cost;
  }

  // Returns whether one block is cheaper than any split can be, so that none need be looked for: a
  // side is no smaller than its largest reference, unless that may be cut.
  bool is_one_block(const SahNode& node, int from) const {
    if (blocks(node.count) > 1 || subtree_.cutting != nullptr) return false;
    const Areas area(node.extent.box);
    const SahReference* references = subtree_.at[from] + node.begin;
    return std::any_of(references, references + node.count, [&](const SahReference& reference) {
      FlatBox box = FlatBox::nothing();
      grow(box.at, reference.lower);
      return is_leaf_cheaper(node.count, area(box));
    });
  }

  Split find_best(const SahNode& node, int from) {
    const SahReference* references = subtree_.at[from] + node.begin;
    Split best;
    for (const SplitKind kind : kSplitKinds) {
      const Binning binning = make_binning(kind, node, best, subtree_.cutting);
      if (binning.count == 0) continue;
      clear(bins_, binning);
      bin(references, node.count, binning, subtree_.cutting, bins_);
      Split split = find_split(node, bins_, binning);
      if (!is_better(node, split, best)) continue;
      if (kind == SplitKind::kPlanes) {
        count_parts(references, node.count, node, split, *subtree_.cutting, split.placed);
        if (split.placed[0] == 0 || split.placed[1] == 0) continue;
      }
      best = split;
    }
    return best;
  }

  void divide(const SahNode& node, int from, const Split& split, SahNode child[2]) const {
    place_sides(node, split.placed, child);
    SahReference* to = subtree_.at[1 - from];
    SahExtent side[2] = {SahExtent::nothing(), SahExtent::nothing()};
    partition(subtree_.at[from] + node.begin, node.count, node, split, subtree_.cutting,
              to + child[0].begin, to + child[1].begin, side);
    for (int k = 0; k < 2; ++k) child[k].extent = side[k];
  }

  // Halves the references in the order they come in, where nothing tells them apart.
  void halve(const SahNode& node, int from, SahNode child[2]) const {
    const uint64_t half = node.count / 2;
    const SahReference* references = subtree_.at[from];
    for (int side = 0; side < 2; ++side) {
      child[side] = {SahExtent::nothing(), node.begin + side * half,
                     side == 0 ? half : node.count - half, 0};
      bound(references + child[side].begin, child[side].count, child[side].extent);
    }
  }

  // Writes a leaf's references. Parts of one triangle, which lie next to each other, become one.
  void finish(const SahNode& node, int from, TopologyNode& leaf) const {
    const SahReference* references = subtree_.at[from] + node.begin;
    const uint64_t first = subtree_.first + node.begin;
    uint32_t* primitives = subtree_.primitives + first;
    Box* cuts = subtree_.cuts == nullptr ? nullptr : subtree_.cuts + first;
    uint32_t kept = 0;
    for (uint64_t i = 0; i < node.count; ++i) {
      if (kept > 0 && primitives[kept - 1] == references[i].primitive) {
        cuts[kept - 1].grow(references[i].box());
        continue;
      }
      primitives[kept] = references[i].primitive;
      if (cuts != nullptr) cuts[kept] = references[i].is_cut != 0 ? references[i].box() : kUncut;
      ++kept;
    }
    leaf.first = static_cast<uint32_t>(first);
    leaf.count = kept;
    // Splits in the middle do not keep the order.
    if (node.count <= subtree_.middle_count) std::sort(primitives, primitives + kept);
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
