// SPDX-License-Identifier: Apache-2.0
// The memory of a batch: its rays, the lists of rays at nodes, and what each octant has left to
// visit.
#if defined(SOBB_TRACE_BATCH_BATCH_MEMORY_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_BATCH_BATCH_MEMORY_INL_H
#undef SOBB_TRACE_BATCH_BATCH_MEMORY_INL_H
#else
#define SOBB_TRACE_BATCH_BATCH_MEMORY_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <new>

#include "trace/batch/leaf_filter-inl.h"
#include "trace/batch/ray_entry.h"
#include "trace/nodes/stack_key.h"
#include "trace/ray/scaled_ray.h"
#include "trace/ray/slab_ray.h"
#include "trace/triangles/candidates-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

inline constexpr uint32_t kOctants = 8;
inline constexpr uint32_t kMostChildren = 8;

// Something to visit: a node or leaf, and the list of rays that meet it; or one ray, which needs no
// list.
struct BatchItem {
  StackKey key;    // without a distance
  uint32_t begin;  // of the list, in the arena; of one ray: its entry
  uint32_t count;  // 0 for one ray
};

// The traversal of the rays of one octant.
struct OctantTraversal {
  // Every level leaves seven children behind, and perhaps a part of its own list; one of them may
  // be where the lists end, at seven rays with eight children each.
  static constexpr uint32_t kMaxItems = kMaxDepth * 8 + 7 * 8;

  RayEntry* arena;    // the lists of the items, one after another
  uint32_t capacity;  // of the arena
  uint32_t octant;
  uint32_t top;    // of the items
  uint32_t stale;  // the items below were pushed before rays last found hits
  BatchItem item[kMaxItems];
};

// One block of memory per thread.
struct Batch {
  // Entries that a list may write past its end: a vector.
  static constexpr uint32_t kSlack = kMaxRayLanes;
  // Arena entries per ray of an octant. With fewer, lists are visited in parts.
  static constexpr uint32_t kArena = 16;

  SlabRay ray[kBatchRays];
  OctantTraversal traversal[kOctants];
  // Lists of rays: by octant before the traversals begin, by child while a node is visited.
  RayEntry list[std::max(kOctants, kMostChildren)][kBatchRays + kSlack];
  RayEntry arena[kArena * kBatchRays + kOctants * kSlack];
  CandidateList<uint32_t> candidates;
  FilterBlock filter[blocks_of(kTriangleMask)];  // of the leaf that a list of rays is before
  // Made ray by ray, since neither has a default.
  bool has_watertight_ray[kBatchRays];  // in any-hit queries, which make it at the first need
  alignas(WatertightRay4) uint8_t watertight_rays[kBatchRays][sizeof(WatertightRay4)];
  alignas(ClosestHit) uint8_t hits[kBatchRays][sizeof(ClosestHit)];

  WatertightRay4& watertight_ray(uint32_t i) {
    return *std::launder(reinterpret_cast<WatertightRay4*>(watertight_rays[i]));
  }
  ClosestHit& best(uint32_t i) { return *std::launder(reinterpret_cast<ClosestHit*>(hits[i])); }

  // Shortens a ray after it took a hit.
  template <Query kQuery>
  void shorten(uint32_t i) {
    ray[i].limit = kQuery == Query::kAny ? -1.0F : scale_limit(best(i).limit, ray[i].scale);
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
