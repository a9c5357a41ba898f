// SPDX-License-Identifier: Apache-2.0
// A bundle: as many rays of a batch as a vector has lanes, one per lane.
#if defined(SOBB_TRACE_BATCH_RAY_BUNDLE_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_BATCH_RAY_BUNDLE_INL_H
#undef SOBB_TRACE_BATCH_RAY_BUNDLE_INL_H
#else
#define SOBB_TRACE_BATCH_RAY_BUNDLE_INL_H
#endif

#include <hwy/highway.h>

#include "base/simd/transpose-inl.h"
#include "trace/batch/ray_entry.h"
#include "trace/ray/ray_vectors-inl.h"
#include "trace/ray/slab_ray.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

struct RayBundle {
  using V = hn::Vec<RayFloats>;

  const SlabRay* ray[kRayLanes];
  V reciprocal[3];
  V near[3];
  V tmin;
  V limit;

  HWY_INLINE RayBundle(const SlabRay* rays, const RayEntry* entries) {
    for (uint32_t i = 0; i < kRayLanes; ++i) ray[i] = rays + entry_ray(entries[i]);
    load(&SlabRay::reciprocal, reciprocal, tmin);
    load(&SlabRay::near, near, limit);
  }

  // Loads three numbers of each ray, and the one behind them.
  HWY_INLINE void load(const float (SlabRay::*member)[3], V (&three)[3], V& fourth) const {
    V column[4];
    load_columns(
        RayFloats(), [&](uint32_t i) { return ray[i]->*member; }, column);
    for (int j = 0; j < 3; ++j) three[j] = column[j];
    fourth = column[3];
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
