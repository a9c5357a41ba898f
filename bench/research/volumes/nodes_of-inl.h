// SPDX-License-Identifier: Apache-2.0
// The nodes of one volume and width: made bottom-up, measured, traced. Included once for each
// Highway target.
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

#include "format/image.h"
#include "trace/single/trace_rays-inl.h"
#include "volumes/nodes.h"
#include "volumes/volume.h"

HWY_BEFORE_NAMESPACE();
namespace sobb::study {
namespace HWY_NAMESPACE {
namespace {

using namespace sobb::HWY_NAMESPACE;  // the tracer's kernels for this target

// What trace_ray is told of a volume's nodes.
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
    std::pmr::vector<Known> roots(wide.subtrees.size(), memory_.get());
    scheduler.for_each(wide.subtrees.size(),
                       [&](uint64_t i) HWY_ATTR { roots[i] = make_part(wide.subtrees[i]); });
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

  // What is known of a subtree: its hull, and where its triangles lie, which is one range.
  struct Known {
    Hull hull;
    BlockRange range;
  };

  void fit_leaf(const WideNode& wide, uint32_t child, Known& leaf) const {
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

  // Last to first, so that children come before their parent. Returns the root's.
  Known make_part(const Part& part) const {
    std::pmr::vector<Known> known(part.nodes.size(), memory_.get());
    for (size_t at = part.nodes.size(); at-- > 0;) {
      const WideNode& wide = part.nodes[at];
      Node& node = *new (&nodes_[part.first_node + at]) Node{};
      for (uint32_t i = 0; i < wide.child_count; ++i) {
        Known leaf;
        if (wide.is_leaf(i)) fit_leaf(wide, i, leaf);
        const Known& child = wide.is_leaf(i) ? leaf : known[wide.index[i] - part.first_node];
        write_child(wide, i, child.hull, {&child.range, 1}, node);
        if (i == 0) {
          known[at] = child;
        } else {
          known[at].hull.merge(child.hull);
          known[at].range = {std::min(known[at].range.first, child.range.first),
                             std::max(known[at].range.end, child.range.end)};
        }
      }
      finish(wide, node);
    }
    return known[0];
  }

  // A child of a node of the top.
  struct TopChild {
    Hull hull;
    std::vector<BlockRange> ranges;
  };

  // The top's hulls one after the other, its volumes in parallel: each looks at many triangles.
  void make_top(const std::pmr::vector<Known>& roots, const Scheduler& scheduler) const {
    const WideTopology& wide = layout_.wide;
    const size_t count = wide.top.nodes.size();
    std::vector<TopChild> children(count * W);
    size_t subtree = roots.size();
    for (size_t at = count; at-- > 0;) {
      const WideNode& node = wide.top.nodes[at];
      for (uint32_t i = node.child_count; i-- > 0;) {
        TopChild& child = children[at * W + i];
        const bool has_subtree = subtree > 0 && wide.places[subtree - 1].node == at &&
                                 wide.places[subtree - 1].child == i;
        if (has_subtree || node.is_leaf(i)) {
          Known leaf;
          if (!has_subtree) fit_leaf(node, i, leaf);
          const Known& known = has_subtree ? roots[--subtree] : leaf;
          child = {known.hull, {known.range}};
        } else {
          merge_children(wide.top.nodes[node.index[i]], &children[size_t{node.index[i]} * W],
                         child);
        }
      }
    }
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

  static void merge_children(const WideNode& node, const TopChild* children, TopChild& merged) {
    merged = children[0];
    for (uint32_t i = 1; i < node.child_count; ++i) {
      merged.hull.merge(children[i].hull);
      merged.ranges.insert(merged.ranges.end(), children[i].ranges.begin(),
                           children[i].ranges.end());
    }
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
