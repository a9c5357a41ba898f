// SPDX-License-Identifier: Apache-2.0
// The rays of a wave, what each has still to visit, and the memory of all. Included once for each
// Highway target.
#if defined(SOBB_TRACE_WAVE_WAVE_RAY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_WAVE_WAVE_RAY_INL_H
#undef SOBB_TRACE_WAVE_WAVE_RAY_INL_H
#else
#define SOBB_TRACE_WAVE_WAVE_RAY_INL_H
#endif

#include <hwy/highway.h>

#include <new>

#include "format/layout.h"
#include "trace/nodes/ray_table-inl.h"
#include "trace/nodes/stack_key.h"
#include "trace/ray/slab_ray.h"
#include "trace/triangles/candidates-inl.h"
#include "trace/triangles/watertight_ray-inl.h"

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
  alignas(BlockRay) uint8_t block_ray[sizeof(BlockRay)];
  alignas(ClosestHit) uint8_t hit[sizeof(ClosestHit)];
  alignas(64) StackKey stack[kStack];  // kNoKey, then in no order
  alignas(RayTable) uint8_t table[sizeof(RayTable)];

  const BlockRay& triangles() const {
    return *std::launder(reinterpret_cast<const BlockRay*>(block_ray));
  }
  ClosestHit& best() { return *std::launder(reinterpret_cast<ClosestHit*>(hit)); }
  const RayTable& directions() const {
    return *std::launder(reinterpret_cast<const RayTable*>(table));
  }

  void set_limit(float to) {
    slabs.limit = to;
    last = last_key(to);
  }
};

// What a ray does next.
enum Visit : uint8_t { kVisitNode, kVisitLeaf, kVisitNothing, kVisits };

// By the triangles that its key names. With kNoKey's there may be a leaf.
struct VisitTable {
  Visit of[kTriangleMask + 1] = {};

  constexpr VisitTable() {
    for (Visit& visit : of) visit = kVisitLeaf;
    of[0] = kVisitNode;
    of[key_triangles(kNoKey)] = kVisitNothing;
  }
};
inline constexpr VisitTable kVisitTable;

// Rays that do the same next, and where what their keys name lies.
template <int W>
struct alignas(256) WaveQueue {
  const uint8_t* base;
  size_t stride;
  size_t last_line;  // of what is there, from its first
  size_t count;
  WaveRay<W>* ray[kWaveRays];
};
static_assert(sizeof(WaveQueue<8>) <= 256);

template <int W>
struct WaveMemory {
  WaveRay<W> ray[kWaveRays];
  WaveQueue<W> queue[2][kVisits];  // of this turn and of the next, changing places
  LeafHits<WaveRay<W>*> hits;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
