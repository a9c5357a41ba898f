// SPDX-License-Identifier: Apache-2.0
// The rays of a batch as the stream traversal reads them, and the memory that it takes. Included
// once for each Highway target.
#if defined(SOBB_TRACE_BATCH_BATCH_RAYS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_BATCH_BATCH_RAYS_INL_H
#undef SOBB_TRACE_BATCH_BATCH_RAYS_INL_H
#else
#define SOBB_TRACE_BATCH_BATCH_RAYS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <new>

#include "trace/batch/leaf_filter-inl.h"
#include "trace/batch/ray_entry.h"
#include "trace/nodes/ray_table-inl.h"
#include "trace/nodes/stack_key.h"
#include "trace/ray/scaled_ray.h"
#include "trace/ray/slab_ray.h"
#include "trace/triangles/candidates-inl.h"
#include "trace/triangles/watertight_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

inline constexpr uint32_t kOctants = 8;
inline constexpr uint32_t kMostChildren = 8;

// Something to visit: a node or leaf, and the rays that meet it; or one ray, which needs no list.
struct StreamItem {
  StackKey key;    // without a distance
  uint32_t begin;  // of the list, in the arena; of one ray: its entry
  uint32_t count;  // 0 for one ray
};

// Rays of one octant on their way through the hierarchy.
struct Stream {
  // Every level leaves seven children behind, and perhaps a part of its own list; one of them may
  // be where the lists end, at seven rays with eight children each.
  static constexpr uint32_t kMaxItems = kMaxDepth * 8 + 7 * 8;

  RayEntry* arena;    // the lists of the items, one after another
  uint32_t capacity;  // of the arena
  uint32_t octant;
  uint32_t top;    // of the items
  uint32_t stale;  // the items below were pushed before rays last found hits
  StreamItem item[kMaxItems];
};

// All that a batch needs, one block of memory a thread.
struct StreamBatch {
  // Entries that a list may write past its end: a vector.
  static constexpr uint32_t kSlack = 8;
  // Arena entries for each ray of a stream. With fewer, lists are visited in parts.
  static constexpr uint32_t kArena = 16;

  SlabRay ray[kBatchRays];
  Stream stream[kOctants];
  // By octant before the streams begin, then by child, while a node is visited.
  RayEntry list[std::max(kOctants, kMostChildren)][kBatchRays + kSlack];
  RayEntry arena[kArena * kBatchRays + kOctants * kSlack];
  LeafHits<uint32_t> leaf_hits;
  FilterBlock filter[blocks_of(kTriangleMask)];  // of the leaf that a list of rays is before
  // Made ray by ray, since neither has a default.
  bool has_block_ray[kBatchRays];  // where any hit will do
  alignas(BlockRay) uint8_t block_rays[kBatchRays][sizeof(BlockRay)];
  alignas(ClosestHit) uint8_t hits[kBatchRays][sizeof(ClosestHit)];

  BlockRay& block_ray(uint32_t i) {
    return *std::launder(reinterpret_cast<BlockRay*>(block_rays[i]));
  }
  ClosestHit& best(uint32_t i) { return *std::launder(reinterpret_cast<ClosestHit*>(hits[i])); }

  // After a hit was taken.
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
