// SPDX-License-Identifier: Apache-2.0
// An array of rays that need not be coherent: a batch of them goes through the nodes together, each
// node visited once for all rays of an octant that meet it (R. Barringer, T. Akenine-Moller,
// "Dynamic Ray Stream Traversal", 2014; V. Fuetterling et al., "Efficient Ray Tracing Kernels for
// Modern CPU Architectures", 2015). What is left of a list further down goes on ray by ray. The
// octants take turns, one visit each, so that what a visit prefetches arrives while the others have
// theirs.
//
// The room batch/ traces arrays of rays of which many meet the same nodes: bundles of them against
// a node (node_tests-inl.h), lists of those that meet each child (ray_lists-inl.h), and leaves,
// with a float filter in front (leaf_visit-inl.h, leaf_filter-inl.h). It knows ray/, nodes/ and
// triangles/.
#if defined(SOBB_TRACE_BATCH_TRAVERSAL_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_BATCH_TRAVERSAL_INL_H
#undef SOBB_TRACE_BATCH_TRAVERSAL_INL_H
#else
#define SOBB_TRACE_BATCH_TRAVERSAL_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "trace/batch/batch_setup-inl.h"
#include "trace/batch/leaf_visit-inl.h"
#include "trace/batch/node_tests-inl.h"
#include "trace/batch/ray_lists-inl.h"
#include "trace/nodes/child_order.h"
#include "trace/nodes/file_volumes-inl.h"
#include "trace/nodes/prefetch-inl.h"
#include "trace/ray/validity.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Lists of at most so many rays are traversed one ray at a time, whatever the node: they need no
// lists of children.
inline constexpr uint32_t kAlone = 3;

// Steps the traversals of one batch's octants, in whatever order it is asked to.
template <class Volumes, Query kQuery>
class BatchTraversal {
  static constexpr int kWidth = Volumes::kWidth;
  static constexpr bool kFrame = Volumes::kFrameOnly;

 public:
  // `rays` are the batch's as the caller has them.
  BatchTraversal(const TraceScene& scene, const sobb_ray* rays, Batch& batch)
      : scene_(scene),
        nodes_(static_cast<const Node<kWidth>*>(scene.nodes)),
        batch_(batch),
        leaves_(scene, rays, batch) {}

  // Visits what is next. Returns whether there is more.
  HWY_INLINE bool step(OctantTraversal& of) {
    const BatchItem& item = of.item[--of.top];
    const bool stale = of.top < of.stale;
    if (stale) of.stale = of.top;
    const StackKey key = item.key;
    const uint32_t begin = item.begin;
    const uint32_t count = item.count;
    if (count != 0) {
      visit_list(of, key, begin, count, stale);
    } else if (entry_distance(begin) <= batch_.ray[entry_ray(begin)].limit) {
      if (key_is_leaf(key)) {
        leaves_.test_ray(key, entry_ray(begin));
        of.stale = of.top;
      } else {
        const RayEntry one = begin;
        visit_node(of, nodes_[key_index(key)], &one, 1, 0);
      }
    }
    return of.top != 0;
  }

 private:
  HWY_INLINE void visit_list(OctantTraversal& of, StackKey key, uint32_t begin, uint32_t count,
                             bool stale) {
    RayEntry* list = of.arena + begin;
    const uint32_t open = stale ? keep_open(list, count, batch_.ray) : count;
    if (open == 0) return;
    if (key_is_leaf(key)) {
      leaves_.test_list(key, list, open);
      of.stale = of.top;
      return;
    }
    // The children's lists may be kWidth times as long. Where there is no room for that, the rest
    // of this one waits.
    const uint32_t room = (of.capacity - begin - open) / kWidth;
    const uint32_t taken = std::min(open, std::max(room, kAlone));
    const uint32_t rest = open - taken;
    if (rest != 0) push(of, key, begin, rest);
    visit_node(of, nodes_[key_index(key)], list + rest, taken, begin + rest);
  }

  static HWY_INLINE void push(OctantTraversal& of, StackKey key, uint32_t begin, uint32_t count) {
    of.item[of.top++] = {key, begin, count};
  }

  // Visits a node with the rays that meet it; the children's lists go to the arena from `begin` on.
  HWY_INLINE void visit_node(OctantTraversal& of, const Node<kWidth>& node, const RayEntry* rays,
                             uint32_t count, uint32_t begin) {
    if (kFrame || on_frame(node)) {
      visit(of, node, rays, count, begin, FrameNode<kWidth>(node, of.octant));
    } else if ((node.meta[0] & kSharedBit) != 0) {
      visit(of, node, rays, count, begin, SharedNode<kWidth>(scene_, node));
    } else {
      visit(of, node, rays, count, begin, OwnNode<kWidth>(scene_, node));
    }
  }

  template <class NodeTest>
  HWY_INLINE void visit(OctantTraversal& of, const Node<kWidth>& node, const RayEntry* rays,
                        uint32_t count, uint32_t begin, const NodeTest& test) {
    static_assert(NodeTest::kFewest > kAlone);
    if (count >= NodeTest::kFewest) {
      visit_together(of, node, rays, count, begin, test);
      return;
    }
    for (uint32_t i = 0; i < count; ++i) visit_alone(of, node, entry_ray(rays[i]), test);
  }

  // Pushes the children that one ray meets, the nearest on top; in any-hit queries the node's last.
  template <class NodeTest>
  HWY_INLINE void visit_alone(OctantTraversal& of, const Node<kWidth>& node, uint32_t ray,
                              const NodeTest& test) {
    const ChildFloats<kWidth> d;
    const ChildWords<kWidth> du;
    alignas(64) RayEntry entry[kWidth];
    uint32_t met = 0;
    for (size_t first = 0; first < kWidth; first += hn::MaxLanes(d)) {
      const ChildIntervals<kWidth> left = test.alone(batch_.ray[ray], first);
      const auto distances = hn::And(hn::BitCast(du, left.near), hn::Set(du, kEntryDistance));
      hn::Store(hn::Or(distances, hn::Set(du, ray)), du, entry + first);
      met |= mask_bits(d, hn::Le(left.near, left.far)) << first;
    }
    met &= low_bits(child_count(node));
    BatchItem* const base = of.item + of.top;
    BatchItem* top = base;
    for (; met != 0; met &= met - 1) {
      const auto child = static_cast<uint32_t>(std::countr_zero(met));
      const StackKey key = make_key(0, node.meta[child], node.reference[child]);
      prefetch<Node<kWidth>>(scene_, key);
      const RayEntry distance = entry[child];
      *make_room(base, top++, [distance](const BatchItem& below) {
        return kQuery == Query::kClosest && below.begin < distance;
      }) = {key, distance, 0};
    }
    of.top += static_cast<uint32_t>(top - base);
  }

  // Pushes the children that rays of a list meet, on top the one whose nearest ray is nearest; in
  // any-hit queries the node's last.
  template <class NodeTest>
  HWY_INLINE void visit_together(OctantTraversal& of, const Node<kWidth>& node,
                                 const RayEntry* rays, uint32_t count, uint32_t begin,
                                 const NodeTest& test) {
    ChildLists<kWidth> lists;
    for (int i = 0; i < kWidth; ++i) lists.list[i] = batch_.list[i];
    const uint32_t children = child_count(node);
    fill_lists<kQuery>(batch_.ray, rays, count, children, test, lists);

    uint64_t order[kWidth];  // the nearest entry, the child
    uint64_t* end = order;
    for (uint32_t child = 0; child < children; ++child) {
      if (lists.count[child] == 0) continue;
      const uint64_t item = uint64_t{lists.nearest[child]} << 32 | child;
      *make_room(order, end++, [item](uint64_t below) {
        return kQuery == Query::kClosest && below < item;
      }) = item;
    }
    for (const uint64_t* at = order; at != end; ++at) {
      const auto child = static_cast<uint32_t>(*at);
      const StackKey key = make_key(0, node.meta[child], node.reference[child]);
      prefetch<Node<kWidth>>(scene_, key);
      copy_list(lists.list[child], lists.count[child], of.arena + begin);
      push(of, key, begin, lists.count[child]);
      begin += lists.count[child];
    }
  }

  static HWY_INLINE void copy_list(const RayEntry* from, uint32_t count, RayEntry* to) {
    const RayWords d;
    for (uint32_t i = 0; i < count; i += kRayLanes) hn::StoreU(hn::LoadU(d, from + i), d, to + i);
  }

  const TraceScene& scene_;
  const Node<kWidth>* nodes_;
  Batch& batch_;
  LeafVisit<kQuery> leaves_;
};

// Gives each octant its rays: the root's list.
inline void begin_traversals(const uint32_t (&count)[kOctants], Batch& batch) {
  RayEntry* arena = batch.arena;
  for (uint32_t octant = 0; octant < kOctants; ++octant) {
    OctantTraversal& of = batch.traversal[octant];
    of.octant = octant;
    of.arena = arena;
    of.capacity = Batch::kArena * count[octant];
    arena += of.capacity + Batch::kSlack;
    std::copy_n(batch.list[octant], count[octant], of.arena);
    of.item[0] = {kRootKey, 0, count[octant]};
    of.top = count[octant] == 0 ? 0 : 1;
    of.stale = 0;
  }
}

// Traces at most kBatchRays rays. Returns how many were not valid.
template <NodeVolumes Volumes, Query kQuery, class Result>
uint64_t trace_batch(const TraceScene& scene, const sobb_ray* rays, uint32_t count, Result* results,
                     Batch& batch) {
  uint32_t octant_count[kOctants] = {};
  const uint32_t invalid = set_up_batch<kQuery>(scene, rays, count, results, batch, octant_count);
  begin_traversals(octant_count, batch);
  uint32_t active[kOctants];
  uint32_t active_count = 0;
  for (uint32_t octant = 0; octant < kOctants; ++octant) {
    if (octant_count[octant] != 0) active[active_count++] = octant;
  }
  BatchTraversal<Volumes, kQuery> traversal(scene, rays, batch);
  while (active_count != 0) {
    for (uint32_t i = 0; i < active_count;) {
      if (traversal.step(batch.traversal[active[i]])) {
        ++i;
      } else {
        active[i] = active[--active_count];
      }
    }
  }
  for (uint32_t i = 0; i < count; ++i) {
    if (invalid == 0 || is_valid(rays[i])) store(batch.best(i), results[i]);
  }
  return invalid;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
