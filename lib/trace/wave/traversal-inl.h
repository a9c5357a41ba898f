// SPDX-License-Identifier: Apache-2.0
// An array of rays, each on a way of its own: a few of them, a wave, take turns, one visit each, so
// that what a visit asks memory for has the others' visits to arrive. A visit has next to no branch
// that depends on what the ray meets: such a branch, once mispredicted, would cost the others what
// they gain. Included once for each Highway target.
//
// One ray after another waits for memory twice: a node's address is known only after the node
// before it, and a mispredicted branch keeps the processor from looking further ahead.
#if defined(SOBB_TRACE_WAVE_TRAVERSAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_WAVE_TRAVERSAL_INL_H
#undef SOBB_TRACE_WAVE_TRAVERSAL_INL_H
#else
#define SOBB_TRACE_WAVE_TRAVERSAL_INL_H
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <span>

#include "trace/nodes/file_volumes-inl.h"
#include "trace/ray/ray_setup-inl.h"
#include "trace/single/trace_rays-inl.h"
#include "trace/single/traversal-inl.h"
#include "trace/wave/push_table.h"
#include "trace/wave/wave_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Limits that lanes without a child do not reach, by the number of children.
struct ChildLimits {
  alignas(64) float of[16][8] = {};

  constexpr ChildLimits() {
    for (int children = 0; children < 16; ++children) {
      for (int i = 0; i < 8; ++i) of[children][i] = i < children ? INFINITY : -1.0F;
    }
  }
};
inline constexpr ChildLimits kChildLimits;

template <class Volumes, Query kQuery, class Result>
class Wave {
  static constexpr int kWidth = Volumes::kWidth;
  static constexpr size_t kLanes = hn::MaxLanes(ChildFloats<kWidth>());
  static constexpr size_t kParts = kWidth / kLanes;
  // Tables of directions fill the cache with fewer.
  static constexpr uint32_t kRays = Volumes::kFrameOnly ? kWaveRays : kWaveRays * 2 / 3;
  using Node = typename Volumes::Node;
  using Ray = WaveRay<kWidth>;
  using ChildWords = hn::RebindToUnsigned<ChildFloats<kWidth>>;

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
      queue[kVisitNode] = {nodes, sizeof(Node), sizeof(Node) - 64, 0, {}};
      queue[kVisitLeaf] = {blocks, sizeof(TriangleBlock), 128, 0, {}};
      queue[kVisitNothing] = {nodes, 0, 0, 0, {}};
    }
    for (Ray& ray : std::span(memory.ray).first(kRays)) free_[free_count_++] = &ray;
    now_ = memory.queue[0];
    next_ = memory.queue[1];
  }

  // Returns how many rays were not valid.
  uint64_t trace() {
    for (;;) {
      for (int i = 0; i < kVisits; ++i) next_[i].count = 0;
      for (size_t i = 0; i < now_[kVisitNothing].count; ++i) finish(*now_[kVisitNothing].ray[i]);
      while (free_count_ >= RayVectors::kLanes && begun_ < count_) begin_rays();
      visit_nodes();
      visit_leaves();
      std::swap(now_, next_);
      if (free_count_ == kRays && begun_ == count_) return invalid_;
    }
  }

 private:
  // Rays on their way to places of the wave.
  struct Places {
    static constexpr bool kBlockRays = true;
    Ray* of[RayVectors::kLanes];

    SlabRay& slabs(uint32_t i) const { return of[i]->slabs; }
    void* block_ray(uint32_t i) const { return of[i]->block_ray; }
    void* hit(uint32_t i) const { return of[i]->hit; }
  };

  // As many of the next rays as a vector has lanes, or all that are left.
  HWY_INLINE void begin_rays() {
    constexpr uint32_t kSome = RayVectors::kLanes;
    const auto some = static_cast<uint32_t>(std::min<uint64_t>(kSome, count_ - begun_));
    Places places;
    for (Ray*& place : places.of) place = free_[--free_count_];
    const uint32_t valid = RayFiller<Places>(scene_, places).fill(rays_ + begun_, some, 0).valid;
    for (uint32_t i = 0; i < kSome; ++i) {
      if ((valid >> i & 1) != 0) {
        begin(*places.of[i], begun_ + i);
        append(next_[kVisitNode], *places.of[i]);
        continue;
      }
      free_[free_count_++] = places.of[i];
      if (i >= some) continue;
      store_invalid(results_[begun_ + i]);
      ++invalid_;
    }
    begun_ += some;
  }

  static HWY_INLINE void begin(Ray& ray, uint64_t index) {
    for (uint32_t j = 0; j < 3; ++j) {
      const uint32_t falls = std::bit_cast<uint32_t>(ray.slabs.reciprocal[j]) >> 31;
      ray.near_plane[j] = (2 * j + falls) * kPlane;
    }
    ray.last = last_key(ray.slabs.limit);
    ray.stack[0] = kNoKey;
    ray.top = ray.stack + 1;
    ray.next = kRootKey;
    ray.index = index;
    ray.has_table = false;
  }

  HWY_INLINE void finish(Ray& ray) {
    if (ray.next != kNoKey) [[unlikely]] {
      append(now_[kVisitLeaf], ray);
      return;
    }
    store(ray.best(), results_[ray.index]);
    free_[free_count_++] = &ray;
  }

  static HWY_INLINE void append(WaveQueue<kWidth>& queue, Ray& ray) {
    queue.ray[queue.count] = &ray;
    ++queue.count;
  }

  // Takes what is next: `key`, or from the stack, if that matters no more. Asks memory for it.
  HWY_INLINE void go_on(Ray& ray, StackKey* top, StackKey key) {
    const StackKey last = ray.last;
    while (key > last) key = *--top;
    ray.top = top;
    ray.next = key;
    WaveQueue<kWidth>& queue = next_[kVisitTable.of[key_triangles(key)]];
    append(queue, ray);
    const uint8_t* at = queue.base + key_index(key) * queue.stride;
    for (size_t line = 0; line + 64 < sizeof(Node); line += 64) hwy::Prefetch(at + line);
    hwy::Prefetch(at + queue.last_line);
  }

  // The children's intervals along the frame.
  static HWY_INLINE void clip_on_frame(const Ray& ray, const Node& node, size_t first,
                                       hn::Vec<ChildFloats<kWidth>>& near,
                                       hn::Vec<ChildFloats<kWidth>>& far) {
    const ChildFloats<kWidth> d;
    const auto* planes = reinterpret_cast<const uint8_t*>(node.slab) + first * sizeof(float);
    const auto load = [&](size_t at) HWY_ATTR {
      return hn::Load(d, reinterpret_cast<const float*>(planes + at));
    };
    const SlabRay& slabs = ray.slabs;
    for (int j = 0; j < 3; ++j) {
      const auto r = hn::Set(d, slabs.reciprocal[j]);
      const size_t at = ray.near_plane[j];
      near = hn::Max(near, hn::MulAdd(load(at), r, hn::Set(d, slabs.near[j])));
      far = hn::Min(far, hn::MulAdd(load(at ^ kPlane), r, hn::Set(d, slabs.far[j])));
    }
  }

  HWY_INLINE void clip(Ray& ray, const Node& node, size_t first, hn::Vec<ChildFloats<kWidth>>& near,
                       hn::Vec<ChildFloats<kWidth>>& far) {
    if constexpr (HasFrameNodes<Volumes>) {
      if (!Volumes::on_frame(node)) [[unlikely]] {
        if (!ray.has_table) make_table(ray);
        Volumes::clip(ray.directions(), node, first, near, far);
        return;
      }
    }
    clip_on_frame(ray, node, first, near, far);
  }

  HWY_NOINLINE void make_table(Ray& ray) {
    new (ray.table) RayTable(scene_, ray.slabs);
    ray.has_table = true;
  }

  // Children that a ray meets: a bit each, and the upper halves of their keys.
  struct Met {
    uint32_t bits;
    hn::Vec<ChildWords> keys[kParts];
  };

  HWY_INLINE Met meet(Ray& ray, const Node& node) {
    const ChildFloats<kWidth> d;
    const ChildWords du;
    const hn::Rebind<uint16_t, decltype(d)> d16;
    Met met;
    met.bits = 0;
    for (size_t i = 0; i < kParts; ++i) {
      const size_t first = i * kLanes;
      auto near = hn::Set(d, ray.slabs.tmin);
      auto far = hn::Min(hn::Set(d, ray.slabs.limit),
                         hn::Load(d, kChildLimits.of[child_count(node)] + first));
      clip(ray, node, first, near, far);
      const auto missed = hn::Gt(near, far);
      met.bits |= (mask_bits(d, missed) ^ ((1U << kLanes) - 1)) << first;
      const auto meta = hn::PromoteTo(du, hn::Load(d16, node.meta + first));
      met.keys[i] = hn::And(meta, hn::Set(du, kTriangleMask));
      if constexpr (kQuery == Query::kAny) continue;  // nothing is culled; the node's order
      const auto distance = hn::AndNot(hn::Set(du, kKeyMetaMask), hn::BitCast(du, near));
      met.keys[i] = hn::Or(met.keys[i], distance);
      // So that those missed come last.
      met.keys[i] = hn::Or(met.keys[i], hn::BitCast(du, hn::VecFromMask(d, missed)));
    }
    return met;
  }

  HWY_INLINE void visit_nodes() {
    const WaveQueue<kWidth>& queue = now_[kVisitNode];
    if constexpr (!Volumes::kFrameOnly) {
      for (size_t i = 0; i < queue.count; ++i) {
        Ray& ray = *queue.ray[i];
        const Node& node = nodes_[key_index(ray.next)];
        choose(ray, node, meet(ray, node));
      }
      return;
    }
    // All tests, then all choices: a visit as a whole waits for itself longer than the processor
    // looks ahead. (Tests of nodes off the frame are longer than that anyway.)
    Met met[kRays];
    for (size_t i = 0; i < queue.count; ++i) {
      Ray& ray = *queue.ray[i];
      met[i] = meet(ray, nodes_[key_index(ray.next)]);
    }
    for (size_t i = 0; i < queue.count; ++i) {
      Ray& ray = *queue.ray[i];
      choose(ray, nodes_[key_index(ray.next)], met[i]);
    }
  }

  HWY_INLINE void choose(Ray& ray, const Node& node, const Met& met) {
    if constexpr (kQuery == Query::kAny) {
      StackKey* const top = push(ray.top, met, met.bits, node) - 1;
      go_on(ray, top, *top);
      return;
    }
    const ChildWords du;
    auto least = met.keys[0];
    for (size_t i = 1; i < kParts; ++i) least = hn::Min(least, met.keys[i]);
    least = hn::MinOfLanes(du, least);
    uint32_t least_bits = 0;
    for (size_t i = 0; i < kParts; ++i) {
      least_bits |= mask_bits(du, hn::Eq(met.keys[i], least)) << (i * kLanes);
    }
    const auto nearest = static_cast<uint32_t>(std::countr_zero(least_bits));
    // Not by way of the stack, whose top is known without this visit where nothing is met.
    const StackKey nearest_key = StackKey{hn::GetLane(least)} << 32 | node.reference[nearest];
    const StackKey on_top = ray.top[-1];
    StackKey* const top = push(ray.top, met, met.bits & ~(1U << nearest), node);
    const uint64_t none = (uint64_t{met.bits} - 1) >> 63;  // no branch, which compilers would make
    go_on(ray, top - none, nearest_key ^ ((nearest_key ^ on_top) & (0 - none)));
  }

  // Those of the children met that a mask keeps. Returns the stack's new top.
  static HWY_INLINE StackKey* push(StackKey* top, const Met& met, uint32_t kept, const Node& node) {
    for (size_t i = 0; i < kParts; ++i) {
      const size_t first = i * kLanes;
      top = push(top, met.keys[i], hn::Load(ChildWords(), node.reference + first),
                 kept >> first & ((1U << kLanes) - 1));
    }
    return top;
  }

  // Keys of which a mask keeps some. Returns the stack's new top.
  template <class VU>
  static HWY_INLINE StackKey* push(StackKey* top, VU keys, VU references, uint32_t mask) {
    const hn::DFromV<VU> du;
    const hn::Rebind<uint8_t, decltype(du)> d8;
    const hn::Repartition<uint64_t, decltype(du)> d64;
    const auto lanes =
        hn::IndicesFromVec(du, hn::PromoteTo(du, hn::LoadU(d8, kPushTable.lanes<kLanes>(mask))));
    const VU high = hn::TableLookupLanes(keys, lanes);
    const VU low = hn::TableLookupLanes(references, lanes);
    const auto pushed = static_cast<uint32_t>(std::popcount(mask));
    hn::StoreU(hn::BitCast(d64, hn::InterleaveLower(du, low, high)), d64, top);
    if (pushed > kLanes / 2) [[unlikely]] {
      hn::StoreU(hn::BitCast(d64, hn::InterleaveUpper(du, low, high)), d64, top + kLanes / 2);
    }
    return top + pushed;
  }

  // Tests all leaves' triangles, then takes the hits, then goes on.
  HWY_INLINE void visit_leaves() {
    const WaveQueue<kWidth>& leaves = now_[kVisitLeaf];
    for (size_t i = 0; i < leaves.count; ++i) {
      Ray& ray = *leaves.ray[i];
      memory_.hits.add(&ray, ray.triangles(), ray.best().limit, scene_.blocks + key_index(ray.next),
                       key_triangles(ray.next));
      if (!memory_.hits.room()) [[unlikely]]
        take_hits();
    }
    take_hits();
    for (size_t i = 0; i < leaves.count; ++i) {
      Ray& ray = *leaves.ray[i];
      go_on(ray, ray.top - 1, ray.top[-1]);
    }
  }

  HWY_INLINE void take_hits() {
    memory_.hits.take([](Ray* ray, const auto&... hits) HWY_ATTR {
      if (!ray->triangles().template offer<kQuery>(hits..., ray->best())) return;
      if (kQuery == Query::kAny) {
        ray->top = ray->stack + 1;  // nothing else to visit
      } else {
        ray->set_limit(scale_limit(ray->best().limit, ray->slabs.scale));
      }
    });
  }

  static constexpr uint32_t kPlane = sizeof(float) * kWidth;  // from a lower plane to its upper one

  const TraceScene& scene_;
  const Node* nodes_;
  const sobb_ray* rays_;
  uint64_t count_;
  Result* results_;
  WaveMemory<kWidth>& memory_;
  WaveQueue<kWidth>* now_;
  WaveQueue<kWidth>* next_;
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
