// SPDX-License-Identifier: Apache-2.0
// The rays of a wave, what each has still to visit, and the memory of all.
#if defined(SOBB_TRACE_WAVE_WAVE_MEMORY_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_WAVE_WAVE_MEMORY_INL_H
#undef SOBB_TRACE_WAVE_WAVE_MEMORY_INL_H
#else
#define SOBB_TRACE_WAVE_WAVE_MEMORY_INL_H
#endif

#include <hwy/highway.h>

#include <new>

#include "format/layout.h"
#include "trace/nodes/frame_clip-inl.h"
#include "trace/nodes/prefetch-inl.h"
#include "trace/nodes/ray_table-inl.h"
#include "trace/nodes/stack_key.h"
#include "trace/ray/slab_ray.h"
#include "trace/triangles/candidates-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

// Rays of a wave: enough for a step of each to take as long as memory does, few enough for the
// cache of the first level.
inline constexpr uint32_t kWaveRays = 24;

template <int W>
struct alignas(64) WaveRay {
  // A push writes as many keys as there are children.
  static constexpr size_t kStack = 2 + kMaxDepth * (W - 1) + W;

  SlabRay slabs;
  uint32_t near_plane[3];  // in bytes from a node's first plane
  StackKey last;           // last_key() of the limit
  StackKey* top;           // of the stack
  StackKey next;
  uint64_t index;  // in the array
  bool has_table;
  alignas(WatertightRay4) uint8_t watertight_ray[sizeof(WatertightRay4)];
  alignas(ClosestHit) uint8_t hit[sizeof(ClosestHit)];
  alignas(64) StackKey stack[kStack];  // kNoKey, then the others, unordered
  alignas(RayTable) uint8_t table[sizeof(RayTable)];

  // Starts the traversal; slabs, triangles and hit are made already.
  HWY_INLINE void begin(uint64_t at) {
    for (uint32_t j = 0; j < 3; ++j) {
      near_plane[j] =
          static_cast<uint32_t>(FramePlanes<W>::near(j, falls_along(slabs.reciprocal[j])));
    }
    last = last_key(slabs.limit);
    stack[0] = kNoKey;
    top = stack + 1;
    next = kRootKey;
    index = at;
    has_table = false;
  }

  const WatertightRay4& triangles() const {
    return *std::launder(reinterpret_cast<const WatertightRay4*>(watertight_ray));
  }
  ClosestHit& best() { return *std::launder(reinterpret_cast<ClosestHit*>(hit)); }
  const RayTable& directions() const {
    return *std::launder(reinterpret_cast<const RayTable*>(table));
  }

  HWY_NOINLINE void make_table(const TraceScene& scene) {
    new (table) RayTable(scene, slabs);
    has_table = true;
  }

  void set_limit(float to) {
    slabs.limit = to;
    last = last_key(to);
  }
};

// What a ray does next.
enum Visit : uint8_t { kVisitNode, kVisitLeaf, kVisitNothing, kVisits };

// The next visit by the triangle count in the ray's key; a leaf may share kNoKey's count.
struct VisitTable {
  Visit of[kTriangleMask + 1] = {};

  constexpr VisitTable() {
    for (Visit& visit : of) visit = kVisitLeaf;
    of[0] = kVisitNode;
    of[key_triangles(kNoKey)] = kVisitNothing;
  }
};
inline constexpr VisitTable kVisitTable;

// The rays with the same kind of visit next, and where what they visit is prefetched from.
template <int W>
struct alignas(256) WaveQueue {
  PrefetchFrom from;
  size_t count;
  WaveRay<W>* ray[kWaveRays];

  HWY_INLINE void append(WaveRay<W>& more) {
    ray[count] = &more;
    ++count;
  }
};
static_assert(sizeof(WaveQueue<8>) <= 256);

template <int W>
struct WaveMemory {
  WaveRay<W> ray[kWaveRays];
  WaveQueue<W> queue[2][kVisits];  // of this turn and of the next, changing places
  CandidateList<WaveRay<W>*> candidates;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
