// SPDX-License-Identifier: Apache-2.0
// NodesOf are the nodes of one volume and width. It makes them bottom-up, measures and traces them.
#if defined(SOBB_RESEARCH_VOLUMES_NODES_OF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_RESEARCH_VOLUMES_NODES_OF_INL_H
#undef SOBB_RESEARCH_VOLUMES_NODES_OF_INL_H
#else
#define SOBB_RESEARCH_VOLUMES_NODES_OF_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "builder/wide/bottom_up.h"
#include "format/image.h"
#include "trace/single/trace_rays-inl.h"
#include "volumes/nodes.h"
#include "volumes/volume.h"

HWY_BEFORE_NAMESPACE();
namespace sobb::study {
namespace HWY_NAMESPACE {
namespace {

using namespace sobb::HWY_NAMESPACE;  // the tracer's kernels for this target

// The volumes of a node, as trace_rays() asks for them.
template <Volume V, int W>
struct VolumesOf {
  static constexpr int kWidth = W;
  using Children = typename V::template Children<W>;
  struct alignas(64) Node {
    Children children;
    uint32_t reference[W];
    uint16_t meta[W];
  };
  using Ray = typename V::Ray;

  template <class Interval>
  static HWY_INLINE void clip(const Ray& ray, const Node& node, size_t first, Interval& near,
                              Interval& far) {
    V::template clip<W>(ray, node.children, first, near, far);
  }
};

template <Volume V, int W>
class NodesOf final : public Hierarchy::Nodes {
 public:
  NodesOf(const SharedTopology& topology, const ConvertSettings& settings, sobb_isa isa)
      : layout_(topology.layout(W)),
        tables_(settings.method, settings.strategy, bounds_kernels(isa), topology.summary(),
                *topology.memory()),
        memory_(topology.memory()) {}

  void convert(const Scheduler& scheduler) override {
    const WideTopology& wide = layout_.wide;
    // The threads that fill the nodes zero them.
    image_ = Image::allocate(memory_, wide.node_count * sizeof(Node), /*zeroed=*/0);
    nodes_ = reinterpret_cast<Node*>(image_.bytes().data());
    const auto roots = walk_subtrees(wide, SubtreeMaker{*this}, scheduler, *memory_, [](double) {});
    make_top(roots, scheduler);
  }

  uint64_t bytes() const override { return image_.bytes().size(); }

  Areas areas(const Scheduler& scheduler) const override {
    const uint64_t count = layout_.wide.node_count;
    std::pmr::vector<Areas> parts((count + kGrain - 1) / kGrain, memory_.get());
    scheduler.for_ranges(count, kGrain, [&](uint64_t begin, uint64_t end) HWY_ATTR {
      Areas& sum = parts[begin / kGrain];
      for (uint64_t at = begin; at < end; ++at) add_areas(nodes_[at], sum);
    });
    Areas sum;
    for (const Areas& part : parts) {
      sum.inner += part.inner;
      sum.leaf += part.leaf;
    }
    return sum;
  }

  uint64_t count_leaks() const override {
    std::vector<V> above;
    return leaks_below(nodes_[0], above);
  }

  uint64_t intersect(const sobb_ray* rays, uint64_t count, sobb_hit* hits,
                     sobb_count* counts) const override {
    const TraceScene scene = {tables_.chunks.empty() ? DirectionTable() : tables_.chunks[0],
                              {tables_.centre[0], tables_.centre[1], tables_.centre[2]},
                              tables_.radius,
                              nodes_,
                              layout_.blocks().data()};
    return trace_rays<VolumesOf<V, W>, Query::kClosest>(scene, rays, count, hits, counts);
  }

 private:
  using Node = typename VolumesOf<V, W>::Node;
  using Hull = typename V::Hull;
  static constexpr uint64_t kGrain = 4096;

  // A subtree: its hull, and where its triangles lie, which is one range.
  struct BoundedSubtree {
    Hull hull;
    BlockRange range;
  };

  void fit_leaf(const WideNode& wide, uint32_t child, BoundedSubtree& leaf) const {
    const uint64_t count = wide.count[child];
    leaf.range = {wide.index[child], wide.index[child] + blocks_of(count)};
    RelativePoint points[3 * kMaxLeafReferences];
    uint64_t point_count = 0;
    for (uint64_t i = 0; i < count; ++i) {
      const TriangleBlock& block = layout_.blocks()[leaf.range.first + i / 4];
      for (const auto& corner : block.vertex) {
        const float at[3] = {corner[0][i % 4], corner[1][i % 4], corner[2][i % 4]};
        points[point_count++] = tables_.relative(at);
      }
    }
    leaf.hull.fit(tables_, points, point_count);
  }

  void write_child(const WideNode& wide, uint32_t child, const Hull& hull,
                   std::span<const BlockRange> ranges, Node& node) const {
    node.children.set(child, V::fit(tables_, hull, {layout_.blocks().data(), ranges}));
    node.reference[child] = wide.index[child];
    if (wide.is_leaf(child)) {
      node.meta[child] = static_cast<uint16_t>(kLeafBit | wide.count[child]);
    }
  }

  static void finish(const WideNode& wide, Node& node) {
    node.meta[0] |= static_cast<uint16_t>(wide.child_count << kChildCountShift);
  }

  // Makes the nodes of subtrees (builder/wide/bottom_up.h).
  struct SubtreeMaker {
    using Value = BoundedSubtree;
    const NodesOf& nodes;

    void prefetch(const Treelet&, size_t) const {}
    void visit_leaf(const WideNode& wide, uint32_t i, BoundedSubtree& leaf) const {
      nodes.fit_leaf(wide, i, leaf);
    }
    void visit_node(uint64_t index, const WideNode& wide, const BoundedSubtree* const* child,
                    BoundedSubtree& bounded) const {
      Node& node = *new (&nodes.nodes_[index]) Node{};
      bounded = *child[0];
      for (uint32_t i = 0; i < wide.child_count; ++i) {
        nodes.write_child(wide, i, child[i]->hull, {&child[i]->range, 1}, node);
        if (i == 0) continue;
        bounded.hull.merge(child[i]->hull);
        bounded.range = {std::min(bounded.range.first, child[i]->range.first),
                         std::max(bounded.range.end, child[i]->range.end)};
      }
      finish(wide, node);
    }
  };

  // A child of a node of the top, whose triangles lie in several ranges.
  struct TopChild {
    Hull hull;
    std::vector<BlockRange> ranges;
  };

  // Merges the hulls of the top, and keeps every node's children.
  struct TopMaker {
    using Value = TopChild;
    const NodesOf& nodes;
    std::vector<TopChild>& children;  // W per node

    void prefetch(const Treelet&, size_t) const {}
    void visit_leaf(const WideNode& wide, uint32_t i, TopChild& leaf) const {
      BoundedSubtree bounded;
      nodes.fit_leaf(wide, i, bounded);
      leaf = {bounded.hull, {bounded.range}};
    }
    void visit_node(uint64_t index, const WideNode& wide, const TopChild* const* child,
                    TopChild& merged) const {
      merged = *child[0];
      for (uint32_t i = 0; i < wide.child_count; ++i) {
        children[index * W + i] = *child[i];
        if (i == 0) continue;
        merged.hull.merge(child[i]->hull);
        merged.ranges.insert(merged.ranges.end(), child[i]->ranges.begin(), child[i]->ranges.end());
      }
    }
  };

  // The top's hulls are merged one after the other; its volumes are fitted in parallel, since each
  // looks at many triangles.
  void make_top(const std::pmr::vector<BoundedSubtree>& roots, const Scheduler& scheduler) const {
    const WideTopology& wide = layout_.wide;
    const size_t count = wide.top.nodes.size();
    std::vector<TopChild> children(count * W);
    std::pmr::vector<TopChild> top_roots(memory_.get());
    for (const BoundedSubtree& root : roots) top_roots.push_back({root.hull, {root.range}});
    walk_top(wide, TopMaker{*this, children}, *memory_, top_roots);
    scheduler.for_each(count, [&](uint64_t at) HWY_ATTR {
      const WideNode& node = wide.top.nodes[at];
      new (&nodes_[at]) Node{};
      for (uint32_t i = 0; i < node.child_count; ++i) {
        const TopChild& child = children[at * W + i];
        write_child(node, i, child.hull, child.ranges, nodes_[at]);
      }
      finish(node, nodes_[at]);
    });
  }

  void add_areas(const Node& node, Areas& sum) const {
    for (uint32_t i = 0; i < child_count(node); ++i) {
      const bool leaf = (node.meta[i] & kLeafBit) != 0;
      (leaf ? sum.leaf : sum.inner) += node.children.get(i).area(tables_);
    }
  }

  uint64_t leaks_below(const Node& node, std::vector<V>& above) const {
    uint64_t leaks = 0;
    for (uint32_t i = 0; i < child_count(node); ++i) {
      above.push_back(node.children.get(i));
      leaks += (node.meta[i] & kLeafBit) != 0 ? leaks_in_leaf(node, i, above)
                                              : leaks_below(nodes_[node.reference[i]], above);
      above.pop_back();
    }
    return leaks;
  }

  uint64_t leaks_in_leaf(const Node& node, uint32_t child, const std::vector<V>& above) const {
    uint64_t leaks = 0;
    for (uint32_t i = 0; i < (node.meta[child] & kTriangleMask); ++i) {
      const TriangleBlock& block = layout_.blocks()[node.reference[child] + i / 4];
      for (const auto& corner : block.vertex) {
        const double point[3] = {static_cast<double>(corner[0][i % 4]) - tables_.centre[0],
                                 static_cast<double>(corner[1][i % 4]) - tables_.centre[1],
                                 static_cast<double>(corner[2][i % 4]) - tables_.centre[2]};
        for (const V& volume : above) leaks += !volume.contains(tables_, point);
      }
    }
    return leaks;
  }

  const SharedTopology::Layout& layout_;
  Tables tables_;
  std::shared_ptr<Memory> memory_;
  Image image_;
  Node* nodes_ = nullptr;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb::study
HWY_AFTER_NAMESPACE();

#endif
