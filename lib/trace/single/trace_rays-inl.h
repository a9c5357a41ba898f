// SPDX-License-Identifier: Apache-2.0
// An array of rays, traced one at a time.
#if defined(SOBB_TRACE_SINGLE_TRACE_RAYS_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_SINGLE_TRACE_RAYS_INL_H
#undef SOBB_TRACE_SINGLE_TRACE_RAYS_INL_H
#else
#define SOBB_TRACE_SINGLE_TRACE_RAYS_INL_H
#endif

#include <hwy/highway.h>

#include "trace/ray/validity.h"
#include "trace/single/traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

// `counts` may be null. Returns how many rays were not valid.
template <class Volumes, Query kQuery, class Result>
uint64_t trace_rays(const TraceScene& scene, const sobb_ray* rays, uint64_t count, Result* results,
                    sobb_count* counts) {
  uint64_t invalid = 0;
  for (uint64_t i = 0; i < count; ++i) {
    if (counts != nullptr) counts[i] = {};
    if (!is_valid(rays[i])) {
      store_invalid(results[i]);
      ++invalid;
      continue;
    }
    ClosestHit best(rays[i]);
    if (counts != nullptr) {
      trace_ray<Volumes, kQuery>(scene, rays[i], best, WorkCounter{counts[i]});
    } else {
      trace_ray<Volumes, kQuery>(scene, rays[i], best, NoCounter{});
    }
    store(best, results[i]);
  }
  return invalid;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
