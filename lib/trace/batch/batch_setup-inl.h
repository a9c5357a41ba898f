// SPDX-License-Identifier: Apache-2.0
// Makes a batch's rays ready, and lists them by octant.
#if defined(SOBB_TRACE_BATCH_BATCH_SETUP_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_BATCH_BATCH_SETUP_INL_H
#undef SOBB_TRACE_BATCH_BATCH_SETUP_INL_H
#else
#define SOBB_TRACE_BATCH_BATCH_SETUP_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "trace/batch/batch_memory-inl.h"
#include "trace/ray/ray_setup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// RaySetup puts the rays of a batch into these places.
template <Query kQuery>
struct BatchPlaces {
  // In any-hit queries few rays meet the deciding test.
  static constexpr bool kTriangleRays = kQuery == Query::kClosest;
  Batch& batch;

  HWY_INLINE SlabRay& slabs(uint32_t i) const { return batch.ray[i]; }
  HWY_INLINE void begin_hit(uint32_t i, const sobb_ray& ray) const {
    new (batch.hits[i]) ClosestHit(ray);
  }
  template <class... Parts>
  HWY_INLINE void begin_triangles(uint32_t i, const Parts&... parts) const {
    new (batch.watertight_rays[i]) WatertightRay4(parts...);
  }
};

// The octant of rays that are all of one, by their signs along the first three directions, which
// say which planes are the near ones; no octant where they differ or one is not valid.
struct CommonOctant {
  uint32_t octant = 0;
  bool exists;

  HWY_INLINE explicit CommonOctant(const RayFacts& facts) {
    uint32_t alike = facts.valid;
    for (uint32_t j = 0; j < 3; ++j) {
      const uint32_t falls = facts.falls[j];
      octant |= (falls & 1) << j;
      alike &= (falls & 1) != 0 ? falls : ~falls;
    }
    exists = alike == all_lanes(RayFloats());
  }
};

// Makes the valid rays ready and lists them in batch.list by octant, octant_count[octant] each.
// Returns how many rays are not valid.
template <Query kQuery, class Result>
HWY_INLINE uint32_t set_up_batch(const TraceScene& scene, const sobb_ray* rays, uint32_t count,
                                 Result* results, Batch& batch,
                                 uint32_t (&octant_count)[kOctants]) {
  using Places = BatchPlaces<kQuery>;
  RaySetup<Places> setup(scene, Places{batch});
  if (!Places::kTriangleRays) std::fill_n(batch.has_watertight_ray, count, false);
  uint32_t invalid = 0;
  for (uint32_t first = 0; first < count; first += kRayLanes) {
    const uint32_t some = std::min(kRayLanes, count - first);
    const RayFacts facts = setup.make(rays + first, some, first);
    const CommonOctant common(facts);
    if (common.exists) {
      const uint32_t octant = common.octant;
      const hn::CappedTag<RayEntry, kRayLanes> du;
      hn::StoreU(hn::Iota(du, first), du, batch.list[octant] + octant_count[octant]);
      octant_count[octant] += kRayLanes;
      continue;
    }
    for (uint32_t i = 0; i < some; ++i) {
      if ((facts.valid >> i & 1) == 0) {
        store_invalid(results[first + i]);
        ++invalid;
        continue;
      }
      uint32_t octant = 0;
      for (uint32_t j = 0; j < 3; ++j) octant |= (facts.falls[j] >> i & 1) << j;
      batch.list[octant][octant_count[octant]++] = first + i;
    }
  }
  return invalid;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
