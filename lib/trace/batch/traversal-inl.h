// SPDX-License-Identifier: Apache-2.0
// An array of rays that need not be coherent: a batch of them goes through the nodes together, each
// node visited once for all rays of an octant that meet it (R. Barringer, T. Akenine-Moller,
// "Dynamic Ray Stream Traversal", 2014; V. Fuetterling et al., "Efficient Ray Tracing Kernels for
// Modern CPU Architectures", 2015). What is left of a list further down goes on ray by ray. The
// octants take turns, a visit each, so that what a visit asks memory for has the others' visits to
// arrive. Included once for each Highway target.
#if defined(SOBB_TRACE_BATCH_TRAVERSAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_BATCH_TRAVERSAL_INL_H
#undef SOBB_TRACE_BATCH_TRAVERSAL_INL_H
#else
#define SOBB_TRACE_BATCH_TRAVERSAL_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "trace/batch/batch_setup-inl.h"
#include "trace/batch/node_tests-inl.h"
#include "trace/batch/ray_lists-inl.h"
#include "trace/nodes/file_volumes-inl.h"
#include "trace/single/trace_rays-inl.h"
#include "trace/single/traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// So many rays of a list go on alone, whatever the node: they need no lists of children.
inline constexpr uint32_t kAlone = 3;

// From so many rays of a list on, those that a leaf's triangles surely miss are told first.
inline constexpr uint32_t kFewestFiltered = 4;

// The rays of a list that have no hit nearer than it, packed. Returns how many.
HWY_INLINE uint32_t keep_open(RayEntry* list, uint32_t count, const SlabRay* ray) {
  const hn::CappedTag<RayEntry, 8> du;
  const hn::RebindToFloat<decltype(du)> d;
  const hn::RebindToSigned<decltype(du)> di;
  constexpr uint32_t kLanes = hn::MaxLanes(du);
  uint32_t open = 0;
  uint32_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    const auto entries = hn::LoadU(du, list + i);
    constexpr int kStride = std::countr_zero(sizeof(SlabRay) / sizeof(float));
    static_assert(sizeof(SlabRay) == sizeof(float) << kStride);
    const auto rays = hn::AndNot(hn::Set(du, kEntryDistance), entries);
    const auto limits =
        hn::GatherIndex(d, &ray->limit, hn::BitCast(di, hn::ShiftLeft<kStride>(rays)));
    const auto distance = hn::BitCast(d, hn::And(entries, hn::Set(du, kEntryDistance)));
    const auto kept = hn::Le(distance, limits);
    open += store_packed(entries, mask_bits(d, kept), list + open);
  }
  for (; i < count; ++i) {
    const RayEntry entry = list[i];
    list[open] = entry;
    open += entry_distance(entry) <= ray[entry_ray(entry)].limit ? 1 : 0;
  }
  return open;
}

// Steps streams of one batch, in whatever order they are asked to.
template <class Volumes, Query kQuery>
class StreamTracer {
  static constexpr int kWidth = Volumes::kWidth;
  static constexpr bool kFrame = Volumes::kFrameOnly;

 public:
  // `rays` are the batch's as the caller has them.
  StreamTracer(const TraceScene& scene, const sobb_ray* rays, StreamBatch& batch)
      : scene_(scene),
        nodes_(static_cast<const Node<kWidth>*>(scene.nodes)),
        rays_(rays),
        batch_(batch) {}

  // Visits what is next. Returns whether there is more.
  HWY_INLINE bool step(Stream& stream) {
    const StreamItem& item = stream.item[--stream.top];
    const bool stale = stream.top < stream.stale;
    if (stale) stream.stale = stream.top;
    const StackKey key = item.key;
    const uint32_t begin = item.begin;
    const uint32_t count = item.count;
    if (count != 0) {
      visit_list(stream, key, begin, count, stale);
    } else if (entry_distance(begin) <= batch_.ray[entry_ray(begin)].limit) {
      if (key_is_leaf(key)) {
        test_triangles(key, entry_ray(begin));
        stream.stale = stream.top;
      } else {
        const RayEntry one = begin;
        visit_node(stream, nodes_[key_index(key)], &one, 1, 0);
      }
    }
    return stream.top != 0;
  }

 private:
  // Few rays that look for any hit need the deciding test: theirs are made where they are needed.
  HWY_INLINE const BlockRay& block_ray(uint32_t i) {
    if (kQuery == Query::kAny && !batch_.has_block_ray[i]) {
      new (batch_.block_rays[i]) BlockRay(rays_[i]);
      batch_.has_block_ray[i] = true;
    }
    return batch_.block_ray(i);
  }

  HWY_INLINE void test_triangles(StackKey key, uint32_t ray) {
    if (test_leaf<kQuery>(block_ray(ray), scene_.blocks + key_index(key), key_triangles(key),
                          batch_.best(ray))) {
      batch_.shorten<kQuery>(ray);
    }
  }

  // All rays of a list.
  HWY_INLINE void test_list(StackKey key, const RayEntry* list, uint32_t count) {
    const TriangleBlock* const block = scene_.blocks + key_index(key);
    const uint32_t triangles = key_triangles(key);
    if (count >= kFewestFiltered && filter_pays()) {
      const auto blocks = static_cast<uint32_t>(blocks_of(triangles));
      for (uint32_t i = 0; i < blocks; ++i) batch_.filter[i].make(scene_, block[i]);
      for (uint32_t first = 0; first < count; first += RayGroup::kLanes) {
        const ListPart part(list + first, count - first);
        test_group(block, triangles, part.entries, part.filled);
      }
    } else if (kQuery == Query::kAny) {
      for (uint32_t i = 0; i < count; ++i) test_triangles(key, entry_ray(list[i]));
    } else {
      for (uint32_t i = 0; i < count; ++i) list_hits(entry_ray(list[i]), block, triangles);
    }
    if (kQuery == Query::kClosest) take_hits();
  }

  // Not where rays hit most of the leaves that they meet, unless sure hits need no other test.
  bool filter_pays() const { return kQuery == Query::kAny || 2 * passed_ <= tested_; }

  HWY_INLINE void list_hits(uint32_t ray, const TriangleBlock* block, uint32_t triangles) {
    batch_.leaf_hits.add(ray, block_ray(ray), batch_.best(ray).limit, block, triangles);
    if (!batch_.leaf_hits.room()) [[unlikely]]
      take_hits();
  }

  // A group of rays, of which the mask has some, before a leaf.
  HWY_INLINE void test_group(const TriangleBlock* block, uint32_t triangles,
                             const RayEntry* entries, uint32_t open) {
    const FilterRays rays(RayGroup(batch_.ray, entries));
    const FilterBlock* prepared = batch_.filter;
    for (uint32_t first = 0; first < triangles && open != 0; first += 4, ++block, ++prepared) {
      uint32_t may_hit = 0;
      for (uint32_t i = 0; i < std::min(triangles - first, 4U); ++i) {
        const FilterVerdict of = filter<kQuery>(rays, *prepared, i);
        may_hit |= of.may_hit;
        if constexpr (kQuery == Query::kAny) {
          for (uint32_t hit = of.hits & open; hit != 0; hit &= hit - 1) {
            const uint32_t ray = entry_ray(entries[std::countr_zero(hit)]);
            batch_.best(ray).primitive = block->primitive[i];
            batch_.template shorten<kQuery>(ray);
          }
          open &= ~of.hits;
        }
      }
      if constexpr (kQuery == Query::kClosest) {
        tested_ += static_cast<uint32_t>(std::popcount(open));
        passed_ += static_cast<uint32_t>(std::popcount(may_hit & open));
      }
      for (uint32_t left = may_hit & open; left != 0; left &= left - 1) {
        const auto lane = static_cast<uint32_t>(std::countr_zero(left));
        const uint32_t ray = entry_ray(entries[lane]);
        if constexpr (kQuery == Query::kClosest) {
          list_hits(ray, block, 4);
        } else if (block_ray(ray).template test<kQuery>(*block, batch_.best(ray))) {
          batch_.template shorten<kQuery>(ray);
          open &= ~(1U << lane);
        }
      }
    }
  }

  HWY_INLINE void take_hits() {
    batch_.leaf_hits.take([&](uint32_t ray, const auto&... hits) HWY_ATTR {
      if (block_ray(ray).template offer<kQuery>(hits..., batch_.best(ray))) {
        batch_.template shorten<kQuery>(ray);
      }
    });
  }

  HWY_INLINE void visit_list(Stream& stream, StackKey key, uint32_t begin, uint32_t count,
                             bool stale) {
    RayEntry* list = stream.arena + begin;
    const uint32_t open = stale ? keep_open(list, count, batch_.ray) : count;
    if (open == 0) return;
    if (key_is_leaf(key)) {
      test_list(key, list, open);
      stream.stale = stream.top;
      return;
    }
    // The children's lists may be kWidth times as long. Where there is no room for that, the rest
    // of this one waits.
    const uint32_t room = (stream.capacity - begin - open) / kWidth;
    const uint32_t taken = std::min(open, std::max(room, kAlone));
    const uint32_t rest = open - taken;
    if (rest != 0) push(stream, key, begin, rest);
    visit_node(stream, nodes_[key_index(key)], list + rest, taken, begin + rest);
  }

  static HWY_INLINE void push(Stream& stream, StackKey key, uint32_t begin, uint32_t count) {
    stream.item[stream.top++] = {key, begin, count};
  }

  // Rays that meet a node; their children's lists go to the arena from `begin` on.
  HWY_INLINE void visit_node(Stream& stream, const Node<kWidth>& node, const RayEntry* rays,
                             uint32_t count, uint32_t begin) {
    if (kFrame || on_frame(node)) {
      visit(stream, node, rays, count, begin, FrameNode<kWidth>(node, stream.octant));
    } else if ((node.meta[0] & kSharedBit) != 0) {
      visit(stream, node, rays, count, begin, SharedNode<kWidth>(scene_, node));
    } else {
      visit(stream, node, rays, count, begin, OwnNode<kWidth>(scene_, node));
    }
  }

  template <class NodeTest>
  HWY_INLINE void visit(Stream& stream, const Node<kWidth>& node, const RayEntry* rays,
                        uint32_t count, uint32_t begin, const NodeTest& test) {
    static_assert(NodeTest::kFewest > kAlone);
    if (count >= NodeTest::kFewest) {
      visit_together(stream, node, rays, count, begin, test);
      return;
    }
    for (uint32_t i = 0; i < count; ++i) visit_alone(stream, node, entry_ray(rays[i]), test);
  }

  // The children that one ray meets, the nearest on top; where any hit will do, the node's last.
  template <class NodeTest>
  HWY_INLINE void visit_alone(Stream& stream, const Node<kWidth>& node, uint32_t ray,
                              const NodeTest& test) {
    const ChildFloats<kWidth> d;
    const ChildEntries<kWidth> du;
    alignas(64) RayEntry entry[kWidth];
    uint32_t met = 0;
    for (size_t first = 0; first < kWidth; first += hn::MaxLanes(d)) {
      const ChildIntervals<kWidth> of = test.alone(batch_.ray[ray], first);
      const auto distances = hn::And(hn::BitCast(du, of.near), hn::Set(du, kEntryDistance));
      hn::Store(hn::Or(distances, hn::Set(du, ray)), du, entry + first);
      met |= mask_bits(d, hn::Le(of.near, of.far)) << first;
    }
    met &= (1U << child_count(node)) - 1;
    StreamItem* const base = stream.item + stream.top;
    StreamItem* top = base;
    for (; met != 0; met &= met - 1) {
      const auto child = static_cast<uint32_t>(std::countr_zero(met));
      const StackKey key = make_key(0, node.meta[child], node.reference[child]);
      prefetch<Node<kWidth>>(scene_, key);
      StreamItem* at = top++;
      for (; kQuery == Query::kClosest && at != base && at[-1].begin < entry[child]; --at)
        *at = at[-1];
      *at = {key, entry[child], 0};
    }
    stream.top += static_cast<uint32_t>(top - base);
  }

  // The children that rays of a list meet, on top the one whose nearest ray is nearest; where any
  // hit will do, the node's last.
  template <class NodeTest>
  HWY_INLINE void visit_together(Stream& stream, const Node<kWidth>& node, const RayEntry* rays,
                                 uint32_t count, uint32_t begin, const NodeTest& test) {
    ChildLists<kWidth> lists;
    for (int i = 0; i < kWidth; ++i) lists.list[i] = batch_.list[i];
    const uint32_t children = child_count(node);
    fill_lists<kQuery>(batch_.ray, rays, count, children, test, lists);

    uint64_t order[kWidth];  // the nearest entry, the child
    uint32_t met = 0;
    for (uint32_t child = 0; child < children; ++child) {
      if (lists.count[child] == 0) continue;
      const uint64_t key = uint64_t{lists.nearest[child]} << 32 | child;
      uint32_t at = met++;
      for (; kQuery == Query::kClosest && at != 0 && order[at - 1] < key; --at)
        order[at] = order[at - 1];
      order[at] = key;
    }
    for (uint32_t i = 0; i < met; ++i) {
      const auto child = static_cast<uint32_t>(order[i]);
      const StackKey key = make_key(0, node.meta[child], node.reference[child]);
      prefetch<Node<kWidth>>(scene_, key);
      copy_list(lists.list[child], lists.count[child], stream.arena + begin);
      push(stream, key, begin, lists.count[child]);
      begin += lists.count[child];
    }
  }

  static HWY_INLINE void copy_list(const RayEntry* from, uint32_t count, RayEntry* to) {
    const hn::CappedTag<RayEntry, 8> d;
    for (uint32_t i = 0; i < count; i += hn::MaxLanes(d))
      hn::StoreU(hn::LoadU(d, from + i), d, to + i);
  }

  const TraceScene& scene_;
  const Node<kWidth>* nodes_;
  const sobb_ray* rays_;
  StreamBatch& batch_;
  uint32_t tested_ = 0;  // rays before blocks, by the filter,
  uint32_t passed_ = 0;  // and those that it could not tell from hits
};

// Gives each octant its rays: the root's list.
inline void begin_streams(const uint32_t (&count)[kOctants], StreamBatch& batch) {
  RayEntry* arena = batch.arena;
  for (uint32_t octant = 0; octant < kOctants; ++octant) {
    Stream& stream = batch.stream[octant];
    stream.octant = octant;
    stream.arena = arena;
    stream.capacity = StreamBatch::kArena * count[octant];
    arena += stream.capacity + StreamBatch::kSlack;
    std::copy_n(batch.list[octant], count[octant], stream.arena);
    stream.item[0] = {kRootKey, 0, count[octant]};
    stream.top = count[octant] == 0 ? 0 : 1;
    stream.stale = 0;
  }
}

// At most kBatchRays of them. Returns how many were not valid.
template <class Volumes, Query kQuery, class Result>
uint64_t trace_stream(const TraceScene& scene, const sobb_ray* rays, uint32_t count,
                      Result* results, StreamBatch& batch) {
  uint32_t octant_count[kOctants] = {};
  const uint32_t invalid = fill_batch<kQuery>(scene, rays, count, results, batch, octant_count);
  begin_streams(octant_count, batch);
  uint32_t active[kOctants];
  uint32_t active_count = 0;
  for (uint32_t octant = 0; octant < kOctants; ++octant) {
    if (octant_count[octant] != 0) active[active_count++] = octant;
  }
  StreamTracer<Volumes, kQuery> tracer(scene, rays, batch);
  while (active_count != 0) {
    for (uint32_t i = 0; i < active_count;) {
      if (tracer.step(batch.stream[active[i]])) {
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
