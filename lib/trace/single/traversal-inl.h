// SPDX-License-Identifier: Apache-2.0
// One ray through the nodes, nearest child first, whatever their volumes and width.
//
// The room single/ traces rays one at a time. It is the shortest traversal, the one to read first,
// and the one that the others' left-over rays take. It knows ray/, nodes/ and triangles/.
#if defined(SOBB_TRACE_SINGLE_TRAVERSAL_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_SINGLE_TRAVERSAL_INL_H
#undef SOBB_TRACE_SINGLE_TRAVERSAL_INL_H
#else
#define SOBB_TRACE_SINGLE_TRAVERSAL_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include "trace/nodes/child_order.h"
#include "trace/nodes/node_test-inl.h"
#include "trace/nodes/prefetch-inl.h"
#include "trace/single/counter.h"
#include "trace/triangles/watertight_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// What is left to visit; at first the root.
template <int W>
struct TraversalStack {
  StackKey* top;
  StackKey key[2 + kMaxDepth * (W - 1)];  // kNoKey, then the furthest first

  TraversalStack() : top(key + 2) {
    key[0] = kNoKey;
    key[1] = kRootKey;
  }
};

// Pushes the children met, of which there are at least two, without the nearest, whose key it
// returns. Two are the rule and have a path of their own.
template <class Volumes, class Node = typename Volumes::Node>
HWY_INLINE StackKey push_all_but_nearest(const TraceScene& scene, const Node& node,
                                         const NodeHits<Volumes::kWidth>& hits, StackKey*& top) {
  alignas(64) uint32_t key_high[Volumes::kWidth];
  hits.store_keys(node, key_high);
  uint32_t mask = hits.mask;
  const auto next_key = [&]() HWY_ATTR {
    const auto child = static_cast<uint32_t>(std::countr_zero(mask));
    mask &= mask - 1;
    const StackKey key = static_cast<StackKey>(key_high[child]) << 32 | node.reference[child];
    prefetch<Node>(scene, key);
    return key;
  };
  const StackKey first = next_key();
  const StackKey second = next_key();
  if (mask == 0) {
    if (second < first) {
      *top++ = first;
      return second;
    }
    *top++ = second;
    return first;
  }
  StackKey nearest = std::min(first, second);
  StackKey* const base = top;
  *top++ = std::max(first, second);
  do {
    StackKey key = next_key();
    if (key < nearest) std::swap(key, nearest);
    *make_room(base, top++, [key](StackKey other) { return other < key; }) = key;
  } while (mask != 0);
  return nearest;
}

// Pushes the children met of an any-hit query, in the node's order, without the last, whose key it
// returns: the last child is the likeliest to have a hit.
template <class Node>
HWY_INLINE StackKey push_all_but_last(const TraceScene& scene, const Node& node, uint32_t mask,
                                      StackKey*& top) {
  StackKey key;
  for (;; *top++ = key) {
    const auto child = static_cast<uint32_t>(std::countr_zero(mask));
    mask &= mask - 1;
    key = make_key(0, node.meta[child], node.reference[child]);
    if (mask == 0) return key;
    prefetch<Node>(scene, key);
  }
}

// Descends to the next leaf, or to the next node that this ray's side does not cover, and returns
// its key; kNoKey at the end of the traversal. It is a function of its own, so that all that the
// loop needs stays in registers.
template <class Volumes, Query kQuery, class Ray, class Counter>
HWY_NOINLINE StackKey next_leaf(const TraceScene& scene, const Ray& in_memory, float tmin,
                                float limit, TraversalStack<Volumes::kWidth>& stack,
                                Counter counter) {
  constexpr int kWidth = Volumes::kWidth;
  const ChildFloats<kWidth> d;
  const auto* nodes = static_cast<const typename Volumes::Node*>(scene.nodes);
  const auto& ray = in_registers(in_memory);
  const auto least = hn::Set(d, tmin);
  const auto most = hn::Set(d, limit);
  const StackKey last = last_key(limit);
  StackKey* top = stack.top;
  for (;;) {
    StackKey key = *--top;
    while (key > last) key = *--top;
    uint32_t index = key_index(key);
    uint32_t triangles = key_triangles(key);
    for (;;) {
      if (triangles != 0 || !covers<Volumes, Ray>(nodes[index])) {
        stack.top = top;
        return make_key(0, triangles, index);
      }
      const auto& node = nodes[index];
      NodeHits<kWidth> hits;
      test_node<Volumes>(ray, node, least, most, hits);
      counter.add_node(child_count(node));
      if (hits.mask == 0) break;
      if ((hits.mask & (hits.mask - 1)) == 0) {
        const auto child = static_cast<uint32_t>(std::countr_zero(hits.mask));
        index = node.reference[child];
        triangles = node.meta[child] & kTriangleMask;
        continue;
      }
      key = kQuery == Query::kAny ? push_all_but_last(scene, node, hits.mask, top)
                                  : push_all_but_nearest<Volumes>(scene, node, hits, top);
      index = key_index(key);
      triangles = key_triangles(key);
    }
  }
}

// A ray before triangles, and what it found.
struct TriangleSide {
  const WatertightRay4& ray;
  ClosestHit& best;
};

// Traverses to the end, or to a node that this ray's side does not cover, which is then on top of
// the stack. Returns whether it is done.
template <class Volumes, Query kQuery, class Ray, class Counter>
HWY_INLINE bool traverse(const TraceScene& scene, const Ray& ray, const ScaledRay& scaled,
                         TriangleSide triangle_side, TraversalStack<Volumes::kWidth>& stack,
                         Counter counter) {
  ClosestHit& best = triangle_side.best;
  float limit = scale_limit(best.limit, scaled.scale);
  for (;;) {
    const StackKey key = next_leaf<Volumes, kQuery>(scene, ray, scaled.tmin, limit, stack, counter);
    if (key == kNoKey) return true;
    if (!key_is_leaf(key)) {
      *stack.top++ = key;
      return false;
    }
    counter.add_leaf(key_triangles(key));
    if (test_leaf<kQuery>(triangle_side.ray, scene.blocks + key_index(key), key_triangles(key),
                          best)) {
      if (kQuery == Query::kAny) return true;
      limit = scale_limit(best.limit, scaled.scale);
    }
  }
}

// Finishes a traversal that met a node off the frame, with the table of all directions.
template <class Volumes, Query kQuery, class Counter>
HWY_NOINLINE void traverse_off_frame(const TraceScene& scene, const ScaledRay& scaled,
                                     TriangleSide triangle_side,
                                     TraversalStack<Volumes::kWidth>& stack, Counter counter) {
  const typename Volumes::Ray ray(scene, scaled);
  traverse<Volumes, kQuery>(scene, ray, scaled, triangle_side, stack, counter);
}

// Traces one ray. The table of directions is made at the first node off the frame, which many rays
// never meet.
template <NodeVolumes Volumes, Query kQuery, class Counter>
HWY_INLINE void trace_ray(const TraceScene& scene, const sobb_ray& ray, ClosestHit& best,
                          Counter counter) {
  using First =
      std::conditional_t<HasFrameNodes<Volumes>, FrameRay<Volumes::kWidth>, typename Volumes::Ray>;
  const ScaledRay scaled(scene, ray);
  const WatertightRay4 watertight_ray(ray);
  const TriangleSide triangle_side = {watertight_ray, best};
  const First first(scene, scaled);
  TraversalStack<Volumes::kWidth> stack;
  const bool done = traverse<Volumes, kQuery>(scene, first, scaled, triangle_side, stack, counter);
  if constexpr (HasFrameNodes<Volumes>) {
    if (!done) traverse_off_frame<Volumes, kQuery>(scene, scaled, triangle_side, stack, counter);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
