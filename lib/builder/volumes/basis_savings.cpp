// SPDX-License-Identifier: Apache-2.0
#include "builder/volumes/basis_savings.h"

#include <algorithm>
#include <span>
#include <vector>

namespace sobb {
namespace {

// The cost of the table that a ray makes when it first meets directions off the frame, in units of
// a node test. (From 0.7 to 1.2 no scene tried is decided otherwise.)
constexpr float kTableCost = 1.0F;
// Beyond that table, bases must save this share of the nodes' cost: less is not worth the time to
// choose them, a tenth to a quarter of a build. (Crown saves 0.1 %, a robot 4 %.)
constexpr float kLeastShare = 0.02F;
// About this many subtrees of at most this many nodes are the sample.
constexpr uint64_t kSampledNodes = 2048;
constexpr uint32_t kSmallSubtree = 8;
// The most area that a box in a sphere of radius 1 has: a cube's.
constexpr float kMostSceneArea = 8.0F;

// What bases off the frame save in some nodes, as cost times area.
struct BasisSavings {
  float frame_total = 0;     // the nodes and their children, all along the frame
  float saved = 0;           // what the chosen bases save of that
  float off_frame_area = 0;  // the area of the nodes whose chosen bases are off the frame

  void add(const BasisSavings& other) {
    frame_total += other.frame_total;
    saved += other.saved;
    off_frame_area += other.off_frame_area;
  }
};

class BasisSample {
 public:
  BasisSample(const NodeBounder& bounder, const References& references, uint64_t stride)
      : bounder_(bounder), references_(references), stride_(stride) {}

  // Samples every stride-th of a treelet's small subtrees, the first of which is the skipped-th of
  // the hierarchy.
  BasisSavings sample(const Treelet& treelet, uint64_t skipped, Memory& memory) const {
    std::pmr::vector<uint32_t> size(treelet.nodes.size(), 1, &memory);  // nodes of each subtree
    for (size_t at = treelet.nodes.size(); at-- > 0;) {
      for_each_inner(treelet, at, [&](size_t child) { size[at] += size[child]; });
    }
    BasisSavings savings;
    const auto sample_if_small = [&](size_t at) {
      if (size[at] > kSmallSubtree || skipped++ % stride_ != 0) return;
      BoundedChild root;
      add_subtree(treelet, at, root, savings);
    };
    sample_if_small(0);
    for (size_t at = 0; at < treelet.nodes.size(); ++at) {
      if (size[at] > kSmallSubtree) for_each_inner(treelet, at, sample_if_small);
    }
    return savings;
  }

 private:
  template <class Visit>
  static void for_each_inner(const Treelet& treelet, size_t at, const Visit& visit) {
    const WideNode& wide = treelet.nodes[at];
    for (uint32_t i = 0; i < wide.child_count; ++i) {
      if (!wide.is_leaf(i)) visit(static_cast<size_t>(wide.index[i] - treelet.first_node));
    }
  }

  // Bounds a node, and adds what it and those below it save.
  void add_subtree(const Treelet& treelet, size_t at, BoundedChild& node,
                   BasisSavings& savings) const {
    const WideNode& wide = treelet.nodes[at];
    BoundedChild below[kMaxWidth];
    const BoundedChild* child[kMaxWidth] = {};
    for (uint32_t i = 0; i < wide.child_count; ++i) {
      if (wide.is_leaf(i)) {
        bounder_.bound_leaf(references_.part(wide.first[i], wide.count[i]), below[i]);
      } else {
        add_subtree(treelet, wide.index[i] - treelet.first_node, below[i], savings);
      }
      child[i] = &below[i];
    }
    const NodeBases bases = bounder_.bound_node(wide.child_count, child, node);
    savings.frame_total += bases.frame_total;
    savings.saved += bases.frame_total - bases.chosen_total;
    savings.off_frame_area += bases.cost > kFrameCost ? node.area : 0;
  }

  const NodeBounder& bounder_;
  const References& references_;
  uint64_t stride_;
};

}  // namespace

bool other_directions_pay(const NodeBounder& bounder, const WideTopology& wide,
                          const Scheduler& scheduler, Memory& memory) {
  // The top is sampled only where it is all there is: above subtrees no subtree of it is small.
  const std::span<const Treelet> treelets =
      wide.subtrees.empty() ? std::span(&wide.top, 1) : std::span(wide.subtrees);
  const uint64_t stride = std::max<uint64_t>(1, wide.node_count / kSampledNodes);
  const BasisSample sample(bounder, wide.references, stride);
  std::pmr::vector<BasisSavings> savings(treelets.size(), &memory);
  scheduler.for_each(treelets.size(),
                     [&](uint64_t i) { savings[i] = sample.sample(treelets[i], i, memory); });
  BasisSavings all;
  for (const BasisSavings& some : savings) all.add(some);
  // At most all rays that meet the scene make the table.
  const float sampled = 1 / static_cast<float>(stride);
  const float tables = kTableCost * std::min(all.off_frame_area, kMostSceneArea * sampled);
  return all.saved - tables >= kLeastShare * all.frame_total;
}

}  // namespace sobb
