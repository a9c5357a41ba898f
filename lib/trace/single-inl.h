// SPDX-License-Identifier: Apache-2.0
// One ray through the nodes, children nearest first, whatever their volumes and width. Included
// once for each Highway target.
#if defined(SOBB_TRACE_SINGLE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_SINGLE_INL_H
#undef SOBB_TRACE_SINGLE_INL_H
#else
#define SOBB_TRACE_SINGLE_INL_H
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <utility>

#include "trace/node_test-inl.h"
#include "trace/triangle_block-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Counts a ray's work, or does nothing at no cost.
struct NoCounter {
  void add_node(uint32_t) {}
  void add_leaf(uint32_t) {}
};
struct Counter {
  sobb_count& count;
  void add_node(uint32_t children) {
    ++count.nodes;
    count.volumes += children;
  }
  void add_leaf(uint32_t triangles) {
    count.blocks += static_cast<uint32_t>(blocks_of(triangles));
    count.triangles += triangles;
  }
};

// The triangles of a leaf. Returns whether `best` changed.
template <Query kQuery>
HWY_INLINE bool test_leaf(const BlockRay& ray, const TriangleBlock* block, uint32_t triangles,
                          ClosestHit& best) {
  bool found = false;
  for (uint32_t first = 0; first < triangles; first += 4, ++block) {
    found |= ray.test<kQuery>(*block, best);
    if (kQuery == Query::kAny && found) return true;
  }
  return found;
}

// Asks for what a key names, all of a node or as much of a leaf, before it is its turn.
template <class Node>
HWY_INLINE void prefetch(const TraceScene& scene, StackKey key) {
  const auto* nodes = static_cast<const Node*>(scene.nodes);
  const void* at = key_is_leaf(key) ? static_cast<const void*>(scene.blocks + key_index(key))
                                    : static_cast<const void*>(nodes + key_index(key));
  const auto* bytes = static_cast<const uint8_t*>(at);
  for (size_t line = 0; line < sizeof(Node); line += 64) hwy::Prefetch(bytes + line);
}

// Pushes the children met but the nearest, furthest first, and returns the nearest's key. One or
// two are the rule and have paths of their own.
template <int W, class Node>
HWY_INLINE StackKey push_but_nearest(const TraceScene& scene, const NodeHits<W>& hits,
                                     const Node& node, StackKey*& top) {
  uint32_t mask = hits.mask;
  const auto next_child = [&]() HWY_ATTR {
    const auto child = static_cast<uint32_t>(std::countr_zero(mask));
    mask &= mask - 1;
    return child;
  };
  const auto next_key = [&]() HWY_ATTR {
    const StackKey key = hits.key(node, next_child());
    prefetch<Node>(scene, key);
    return key;
  };
  if ((mask & (mask - 1)) == 0) {
    const uint32_t child = next_child();
    return make_key(0, node.meta[child], node.reference[child]);
  }
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
    StackKey* at = top++;
    for (; at != base && at[-1] < key; --at) *at = at[-1];
    *at = key;
  } while (mask != 0);
  return nearest;
}

// The same in the node's order, which a query for any hit is as good with.
template <int W, class Node>
HWY_INLINE StackKey push_but_first(const TraceScene& scene, const NodeHits<W>& hits,
                                   const Node& node, StackKey*& top) {
  uint32_t mask = hits.mask;
  const auto next_key = [&]() HWY_ATTR {
    const auto child = static_cast<uint32_t>(std::countr_zero(mask));
    mask &= mask - 1;
    return make_key(0, node.meta[child], node.reference[child]);
  };
  const StackKey first = next_key();
  while (mask != 0) {
    const StackKey key = next_key();
    prefetch<Node>(scene, key);
    *top++ = key;
  }
  return first;
}

// A ray as traversals read it, whichever way they go.
template <class Volumes>
struct PreparedRay {
  ScaledRay scaled;
  BlockRay block_ray;
  typename Volumes::Ray volume_ray;

  HWY_INLINE PreparedRay(const TraceScene& scene, const sobb_ray& ray)
      : scaled(scene, ray), block_ray(ray), volume_ray(scene, scaled) {}

  float limit(const ClosestHit& best) const { return scale_limit(best.limit, scaled.scale); }
};

// Traces what is below `key`, a node or a leaf that the ray meets.
template <class Volumes, Query kQuery, class CounterType>
HWY_INLINE void traverse_from(const TraceScene& scene, const PreparedRay<Volumes>& ray,
                              StackKey key, ClosestHit& best, CounterType counter) {
  using Node = typename Volumes::Node;
  constexpr int kWidth = Volumes::kWidth;
  const auto* nodes = static_cast<const Node*>(scene.nodes);

  StackKey stack[kMaxDepth * (kWidth - 1) + 1];
  StackKey* top = stack;
  float limit = ray.limit(best);
  for (;;) {
    bool met = true;
    while (met && !key_is_leaf(key)) {
      const Node& node = nodes[key_index(key)];
      NodeHits<kWidth> hits;
      test_node<Volumes>(ray.volume_ray, node, ray.scaled.tmin, limit, hits);
      counter.add_node(child_count(node));
      met = hits.mask != 0;
      if (met && kQuery == Query::kAny) key = push_but_first(scene, hits, node, top);
      if (met && kQuery == Query::kClosest) key = push_but_nearest(scene, hits, node, top);
    }
    if (met) {
      counter.add_leaf(key_triangles(key));
      if (test_leaf<kQuery>(ray.block_ray, scene.blocks + key_index(key), key_triangles(key),
                            best)) {
        if (kQuery == Query::kAny) return;
        limit = ray.limit(best);
      }
    }
    const StackKey last = last_key(limit);
    do {
      if (top == stack) return;
      key = *--top;
    } while (key > last);
  }
}

template <class Volumes, Query kQuery, class CounterType>
HWY_INLINE void trace_ray(const TraceScene& scene, const sobb_ray& ray, ClosestHit& best,
                          CounterType counter) {
  const PreparedRay<Volumes> prepared(scene, ray);
  traverse_from<Volumes, kQuery>(scene, prepared, kRootKey, best, counter);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
