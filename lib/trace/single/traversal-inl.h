// SPDX-License-Identifier: Apache-2.0
// One ray through the nodes, children nearest first, whatever their volumes and width. Included
// once for each Highway target.
#if defined(SOBB_TRACE_SINGLE_TRAVERSAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_SINGLE_TRAVERSAL_INL_H
#undef SOBB_TRACE_SINGLE_TRAVERSAL_INL_H
#else
#define SOBB_TRACE_SINGLE_TRAVERSAL_INL_H
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include "trace/nodes/frame_ray-inl.h"
#include "trace/nodes/node_test-inl.h"
#include "trace/triangles/watertight_ray-inl.h"

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

// Pushes the children met, of which there are at least two, but the nearest, furthest first, and
// returns the nearest's key. Two are the rule and have a path of their own.
template <class Volumes, class Node = typename Volumes::Node>
HWY_INLINE StackKey push_but_nearest(const TraceScene& scene, const Node& node,
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
    StackKey* at = top++;
    for (; at != base && at[-1] < key; --at) *at = at[-1];
    *at = key;
  } while (mask != 0);
  return nearest;
}

// The same for a query for any hit: in the node's order, in which the last child is the likeliest
// to have one.
template <class Node>
HWY_INLINE StackKey push_but_last(const TraceScene& scene, const Node& node, uint32_t mask,
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

// What is left to visit: at first the root.
template <int W>
struct Path {
  StackKey* top;
  StackKey key[2 + kMaxDepth * (W - 1)];  // kNoKey, then the furthest first

  Path() : top(key + 2) {
    key[0] = kNoKey;
    key[1] = kRootKey;
  }
};

// As a loop over nodes wants a ray.
template <class Ray>
HWY_INLINE const Ray& in_registers(const Ray& ray) {
  return ray;
}
template <int W>
HWY_INLINE typename FrameRay<W>::InRegisters in_registers(const FrameRay<W>& ray) {
  return typename FrameRay<W>::InRegisters(ray);
}

template <class Volumes>
concept HasFrameNodes = requires(const typename Volumes::Node& node) {
  Volumes::on_frame(node);
};

// Whether this ray's side is enough for the node.
template <class Volumes, class Ray>
HWY_INLINE bool covers(const typename Volumes::Node& node) {
  if constexpr (HasFrameNodes<Volumes> && std::is_same_v<Ray, FrameRay<Volumes::kWidth>>) {
    return Volumes::on_frame(node);
  }
  return true;
}

// Takes the path to the next leaf, or node that the ray's side is not enough for, and returns its
// key; or to the end, kNoKey. A function of its own, so that all that the loop needs has registers.
template <class Volumes, Query kQuery, class Ray, class CounterType>
HWY_NOINLINE StackKey next_stop(const TraceScene& scene, const Ray& in_memory, float tmin,
                                float limit, Path<Volumes::kWidth>& path, CounterType counter) {
  constexpr int kWidth = Volumes::kWidth;
  const ChildFloats<kWidth> d;
  const auto* nodes = static_cast<const typename Volumes::Node*>(scene.nodes);
  const auto& ray = in_registers(in_memory);
  const auto least = hn::Set(d, tmin);
  const auto most = hn::Set(d, limit);
  const StackKey last = last_key(limit);
  StackKey* top = path.top;
  for (;;) {
    StackKey key = *--top;
    while (key > last) key = *--top;
    uint32_t index = key_index(key);
    uint32_t triangles = key_triangles(key);
    for (;;) {
      if (triangles != 0 || !covers<Volumes, Ray>(nodes[index])) {
        path.top = top;
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
      key = kQuery == Query::kAny ? push_but_last(scene, node, hits.mask, top)
                                  : push_but_nearest<Volumes>(scene, node, hits, top);
      index = key_index(key);
      triangles = key_triangles(key);
    }
  }
}

// A ray before triangles, and what it found.
struct TriangleSide {
  const BlockRay& ray;
  ClosestHit& best;
};

// Takes the path to its end, or to a node that the ray's side is not enough for, which is then on
// top. Returns whether to its end.
template <class Volumes, Query kQuery, class Ray, class CounterType>
HWY_INLINE bool take_path(const TraceScene& scene, const Ray& ray, const ScaledRay& scaled,
                          TriangleSide triangle_side, Path<Volumes::kWidth>& path,
                          CounterType counter) {
  ClosestHit& best = triangle_side.best;
  float limit = scale_limit(best.limit, scaled.scale);
  for (;;) {
    const StackKey key = next_stop<Volumes, kQuery>(scene, ray, scaled.tmin, limit, path, counter);
    if (key == kNoKey) return true;
    if (!key_is_leaf(key)) {
      *path.top++ = key;
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

// Takes it to its end.
template <class Volumes, Query kQuery, class CounterType>
HWY_NOINLINE void take_rest(const TraceScene& scene, const ScaledRay& scaled,
                            TriangleSide triangle_side, Path<Volumes::kWidth>& path,
                            CounterType counter) {
  const typename Volumes::Ray ray(scene, scaled);
  take_path<Volumes, kQuery>(scene, ray, scaled, triangle_side, path, counter);
}

// As long as nodes lie along the frame there is no table, which many rays never need.
template <class Volumes, Query kQuery, class CounterType>
HWY_INLINE void trace_ray(const TraceScene& scene, const sobb_ray& ray, ClosestHit& best,
                          CounterType counter) {
  using First =
      std::conditional_t<HasFrameNodes<Volumes>, FrameRay<Volumes::kWidth>, typename Volumes::Ray>;
  const ScaledRay scaled(scene, ray);
  const BlockRay block_ray(ray);
  const TriangleSide triangle_side = {block_ray, best};
  const First first(scene, scaled);
  Path<Volumes::kWidth> path;
  const bool done = take_path<Volumes, kQuery>(scene, first, scaled, triangle_side, path, counter);
  if constexpr (HasFrameNodes<Volumes>) {
    if (!done) take_rest<Volumes, kQuery>(scene, scaled, triangle_side, path, counter);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
