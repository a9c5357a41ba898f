// SPDX-License-Identifier: Apache-2.0
// An array of rays, each on a path of its own: a few of them, a wave, take turns, one visit each,
// so that what a visit prefetches arrives while the others have theirs. A visit has next to no
// branch that depends on what the ray meets: such a branch, once mispredicted, would cost the
// others what they gain.
//
// Traced one after another, rays wait for memory twice: a node's address is known only after the
// node before it, and a mispredicted branch keeps the processor from looking further ahead.
//
// The room wave/ traces arrays of rays that diverge: the rays of a wave and their queues
// (wave_memory-inl.h), what a visit does with a node's children (wave_children-inl.h), and the
// turns (this file). It knows ray/, nodes/ and triangles/.
#if defined(SOBB_TRACE_WAVE_TRAVERSAL_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_WAVE_TRAVERSAL_INL_H
#undef SOBB_TRACE_WAVE_TRAVERSAL_INL_H
#else
#define SOBB_TRACE_WAVE_TRAVERSAL_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <span>

#include "trace/nodes/file_volumes-inl.h"
#include "trace/ray/ray_setup-inl.h"
#include "trace/wave/wave_children-inl.h"
#include "trace/wave/wave_memory-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

template <NodeVolumes Volumes, Query kQuery, class Result>
class Wave {
  static constexpr int kWidth = Volumes::kWidth;
  // Fewer where the tables of directions fill the cache.
  static constexpr uint32_t kRays = Volumes::kFrameOnly ? kWaveRays : kWaveRays * 2 / 3;
  using Node = typename Volumes::Node;
  using Ray = WaveRay<kWidth>;
  using Queue = WaveQueue<kWidth>;
  using Children = WaveChildren<Volumes, kQuery>;

 public:
  Wave(const TraceScene& scene, const sobb_ray* rays, uint64_t count, Result* results,
       WaveMemory<kWidth>& memory)
      : scene_(scene),
        nodes_(static_cast<const Node*>(scene.nodes)),
        rays_(rays),
        count_(count),
        results_(results),
        memory_(memory) {
    const auto* nodes = static_cast<const uint8_t*>(scene.nodes);
    const auto* blocks = reinterpret_cast<const uint8_t*>(scene.blocks);
    for (auto& queue : memory.queue) {
      queue[kVisitNode] = {{nodes, sizeof(Node), sizeof(Node) - kCacheLine}, 0, {}};
      queue[kVisitLeaf] = {{blocks, sizeof(TriangleBlock), 2 * kCacheLine}, 0, {}};
      queue[kVisitNothing] = {{nodes, 0, 0}, 0, {}};
    }
    for (Ray& ray : std::span(memory.ray).first(kRays)) free_[free_count_++] = &ray;
    now_ = memory.queue[0];
    next_ = memory.queue[1];
  }

  // Returns how many rays were not valid. Kept out of its callers, where GCC leaves it fewer
  // registers: inlined on SSE4 it loses 1 to 6 % of bounces and random rays.
  HWY_NOINLINE uint64_t trace() {
    for (;;) {
      for (int i = 0; i < kVisits; ++i) next_[i].count = 0;
      for (size_t i = 0; i < now_[kVisitNothing].count; ++i) finish(*now_[kVisitNothing].ray[i]);
      while (free_count_ >= kRayLanes && begun_ < count_) begin_rays();
      visit_nodes();
      visit_leaves();
      std::swap(now_, next_);
      if (free_count_ == kRays && begun_ == count_) return invalid_;
    }
  }

 private:
  // RaySetup puts rays into these free places of the wave.
  struct Places {
    static constexpr bool kTriangleRays = true;
    Ray* of[kRayLanes];

    HWY_INLINE SlabRay& slabs(uint32_t i) const { return of[i]->slabs; }
    HWY_INLINE void begin_hit(uint32_t i, const sobb_ray& ray) const {
      new (of[i]->hit) ClosestHit(ray);
    }
    template <class... Parts>
    HWY_INLINE void begin_triangles(uint32_t i, const Parts&... parts) const {
      new (of[i]->watertight_ray) WatertightRay4(parts...);
    }
  };

  // Begins as many of the next rays as a vector has lanes, or all that are left.
  HWY_INLINE void begin_rays() {
    const auto some = static_cast<uint32_t>(std::min<uint64_t>(kRayLanes, count_ - begun_));
    Places places;
    for (Ray*& place : places.of) place = free_[--free_count_];
    const uint32_t valid = RaySetup<Places>(scene_, places).make(rays_ + begun_, some, 0).valid;
    for (uint32_t i = 0; i < kRayLanes; ++i) {
      if ((valid >> i & 1) != 0) {
        places.of[i]->begin(begun_ + i);
        next_[kVisitNode].append(*places.of[i]);
        continue;
      }
      free_[free_count_++] = places.of[i];
      if (i >= some) continue;
      store_invalid(results_[begun_ + i]);
      ++invalid_;
    }
    begun_ += some;
  }

  HWY_INLINE void finish(Ray& ray) {
    if (ray.next != kNoKey) [[unlikely]] {  // a leaf that shares kNoKey's triangle count
      now_[kVisitLeaf].append(ray);
      return;
    }
    store(ray.best(), results_[ray.index]);
    free_[free_count_++] = &ray;
  }

  // Takes what is next, `key` or what is on the stack if that is culled, and prefetches it.
  HWY_INLINE void go_on(Ray& ray, StackKey* top, StackKey key) {
    const StackKey last = ray.last;
    while (key > last) key = *--top;
    ray.top = top;
    ray.next = key;
    Queue& queue = next_[kVisitTable.of[key_triangles(key)]];
    queue.append(ray);
    queue.from.template prefetch<Node>(key_index(key));
  }

  HWY_INLINE void visit_nodes() {
    const Queue& queue = now_[kVisitNode];
    if constexpr (!Volumes::kFrameOnly) {
      for (size_t i = 0; i < queue.count; ++i) {
        Ray& ray = *queue.ray[i];
        const Node& node = nodes_[key_index(ray.next)];
        Children children;
        children.test(scene_, ray, node);
        choose(ray, node, children);
      }
      return;
    }
    // All tests, then all choices: a visit as a whole waits for itself longer than the processor
    // looks ahead. (Tests of nodes off the frame are longer than that anyway.)
    Children children[kRays];
    for (size_t i = 0; i < queue.count; ++i) {
      Ray& ray = *queue.ray[i];
      children[i].test(scene_, ray, nodes_[key_index(ray.next)]);
    }
    for (size_t i = 0; i < queue.count; ++i) {
      Ray& ray = *queue.ray[i];
      choose(ray, nodes_[key_index(ray.next)], children[i]);
    }
  }

  HWY_INLINE void choose(Ray& ray, const Node& node, const Children& children) {
    const auto next = children.push_all_but_next(node, ray.top);
    go_on(ray, next.top, next.key);
  }

  // Tests all leaves' triangles, then takes the hits, then goes on.
  HWY_INLINE void visit_leaves() {
    const Queue& leaves = now_[kVisitLeaf];
    for (size_t i = 0; i < leaves.count; ++i) {
      Ray& ray = *leaves.ray[i];
      memory_.candidates.add(&ray, ray.triangles(), ray.best().limit,
                             scene_.blocks + key_index(ray.next), key_triangles(ray.next));
      if (!memory_.candidates.has_room()) [[unlikely]]
        take_hits();
    }
    take_hits();
    for (size_t i = 0; i < leaves.count; ++i) {
      Ray& ray = *leaves.ray[i];
      go_on(ray, ray.top - 1, ray.top[-1]);
    }
  }

  HWY_INLINE void take_hits() {
    memory_.candidates.take([](Ray* ray, const auto&... hits) HWY_ATTR {
      if (!ray->triangles().template offer<kQuery>(hits..., ray->best())) return;
      if (kQuery == Query::kAny) {
        ray->top = ray->stack + 1;  // nothing else to visit
      } else {
        ray->set_limit(scale_limit(ray->best().limit, ray->slabs.scale));
      }
    });
  }

  const TraceScene& scene_;
  const Node* nodes_;
  const sobb_ray* rays_;
  uint64_t count_;
  Result* results_;
  WaveMemory<kWidth>& memory_;
  Queue* now_;
  Queue* next_;
  uint64_t begun_ = 0;
  uint64_t invalid_ = 0;
  uint32_t free_count_ = 0;
  Ray* free_[kRays];
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
