// SPDX-License-Identifier: Apache-2.0
// A batch's rays made ready. Included once for each Highway target.
#if defined(SOBB_TRACE_BATCH_BATCH_SETUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_BATCH_BATCH_SETUP_INL_H
#undef SOBB_TRACE_BATCH_BATCH_SETUP_INL_H
#else
#define SOBB_TRACE_BATCH_BATCH_SETUP_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>

#include "trace/batch/batch_rays-inl.h"
#include "trace/ray/ray_setup-inl.h"
#include "trace/single/trace_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

template <Query kQuery>
struct BatchPlaces {
  static constexpr bool kBlockRays = kQuery == Query::kClosest;
  StreamBatch& batch;

  SlabRay& slabs(uint32_t i) const { return batch.ray[i]; }
  void* block_ray(uint32_t i) const { return batch.block_rays[i]; }
  void* hit(uint32_t i) const { return batch.hits[i]; }
};

// Makes the batch of the valid rays. Returns how many are not; of those of each octant there are,
// in its list, so many.
template <Query kQuery, class Result>
HWY_INLINE uint32_t fill_batch(const TraceScene& scene, const sobb_ray* rays, uint32_t count,
                               Result* results, StreamBatch& batch,
                               uint32_t (&octant_count)[kOctants]) {
  constexpr uint32_t kLanes = RayVectors::kLanes;
  using Places = BatchPlaces<kQuery>;
  RayFiller<Places> filler(scene, Places{batch});
  if (!Places::kBlockRays) std::fill_n(batch.has_block_ray, count, false);
  uint32_t invalid = 0;
  for (uint32_t first = 0; first < count; first += kLanes) {
    const uint32_t some = std::min(kLanes, count - first);
    const FilledRays filled = filler.fill(rays + first, some, first);
    // The octant: the signs of the cosines, which say which planes are the near ones.
    constexpr uint32_t kAll = (1U << kLanes) - 1;
    uint32_t octant = 0;
    uint32_t alike = filled.valid;
    for (uint32_t j = 0; j < 3; ++j) {
      const uint32_t falls = filled.falls[j];
      octant |= (falls & 1) << j;
      alike &= (falls & 1) != 0 ? falls : ~falls;
    }
    if (alike == kAll) {
      const hn::CappedTag<RayEntry, kLanes> du;
      hn::StoreU(hn::Iota(du, first), du, batch.list[octant] + octant_count[octant]);
      octant_count[octant] += kLanes;
      continue;
    }
    for (uint32_t i = 0; i < some; ++i) {
      if ((filled.valid >> i & 1) == 0) {
        store_invalid(results[first + i]);
        ++invalid;
        continue;
      }
      octant = 0;
      for (uint32_t j = 0; j < 3; ++j) octant |= (filled.falls[j] >> i & 1) << j;
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
