// SPDX-License-Identifier: Apache-2.0
// As many rays of a batch as a vector has lanes, one a lane. Included once for each Highway target.
#if defined(SOBB_TRACE_BATCH_RAY_BUNDLE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_BATCH_RAY_BUNDLE_INL_H
#undef SOBB_TRACE_BATCH_RAY_BUNDLE_INL_H
#else
#define SOBB_TRACE_BATCH_RAY_BUNDLE_INL_H
#endif

#include <hwy/highway.h>

#include "base/simd/transpose-inl.h"
#include "trace/batch/ray_entry.h"
#include "trace/nodes/ray_table-inl.h"
#include "trace/ray/ray_vectors-inl.h"
#include "trace/ray/slab_ray.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

struct RayGroup {
  using V = hn::Vec<RayFloats>;
  static constexpr uint32_t kLanes = hn::MaxLanes(RayFloats());

  const SlabRay* ray[kLanes];
  V reciprocal[3];
  V near[3];
  V tmin;
  V limit;

  HWY_INLINE RayGroup(const SlabRay* rays, const RayEntry* entries) {
    for (uint32_t i = 0; i < kLanes; ++i) ray[i] = rays + entry_ray(entries[i]);
    load_rows(&SlabRay::reciprocal, reciprocal, tmin);
    load_rows(&SlabRay::near, near, limit);
  }

  // Three numbers of each ray, and the one behind them.
  HWY_INLINE void load_rows(const float (SlabRay::*row)[3], V (&three)[3], V& fourth) const {
    V column[4];
    transpose_blocks(rows<RayFloats>(row, 0), rows<RayFloats>(row, 1), rows<RayFloats>(row, 2),
                     rows<RayFloats>(row, 3), column);
    for (int j = 0; j < 3; ++j) three[j] = column[j];
    fourth = column[3];
  }

 private:
  // Those of ray i, and if a vector has room, of the one four behind.
  template <class D>
  HWY_INLINE hn::Vec<D> rows(const float (SlabRay::*row)[3], uint32_t i) const {
    const D d;
    const hn::CappedTag<hn::TFromD<D>, 4> d4;
    if constexpr (hn::MaxLanes(d) == 4) {
      return hn::Load(d4, ray[i]->*row);
    } else {
      return hn::Combine(d, hn::Load(d4, ray[i + 4]->*row), hn::Load(d4, ray[i]->*row));
    }
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
