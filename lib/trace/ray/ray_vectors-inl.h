// SPDX-License-Identifier: Apache-2.0
// As many rays as a vector has lanes, one a lane. Included once for each Highway target.
#if defined(SOBB_TRACE_RAY_RAY_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_RAY_RAY_VECTORS_INL_H
#undef SOBB_TRACE_RAY_RAY_VECTORS_INL_H
#else
#define SOBB_TRACE_RAY_RAY_VECTORS_INL_H
#endif

#include <hwy/highway.h>

#include <cfloat>

#include "sobb/sobb.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using RayFloats = hn::CappedTag<float, 8>;
using RayWords = hn::RebindToUnsigned<RayFloats>;

struct RayVectors {
  using V = hn::Vec<RayFloats>;
  using M = hn::Mask<RayFloats>;
  static constexpr uint32_t kLanes = hn::MaxLanes(RayFloats());

  V origin[3];
  V direction[3];
  V tmin;
  V tmax;

  HWY_INLINE explicit RayVectors(const sobb_ray* rays) {
    static_assert(sizeof(sobb_ray) == 8 * sizeof(float));
    const RayFloats d;
    // Half as many rays at once: origins in even lanes, directions in odd ones.
    V a[4];
    V b[4];
    const float* at = rays->origin;
    hn::LoadInterleaved4(d, at, a[0], a[1], a[2], a[3]);
    hn::LoadInterleaved4(d, at + 4 * kLanes, b[0], b[1], b[2], b[3]);
    for (int k = 0; k < 3; ++k) {
      origin[k] = hn::ConcatEven(d, b[k], a[k]);
      direction[k] = hn::ConcatOdd(d, b[k], a[k]);
    }
    tmin = hn::ConcatEven(d, b[3], a[3]);
    tmax = hn::ConcatOdd(d, b[3], a[3]);
  }
};

// The axis along which directions are largest, as TriangleRay chooses it.
struct LargestAxis {
  using V = hn::Vec<RayFloats>;
  using M = hn::Mask<RayFloats>;

  M x;
  M y;

  // From their magnitudes.
  HWY_INLINE explicit LargestAxis(const V (&size)[3]) {
    const auto x_y = hn::Ge(size[0], size[1]);
    x = hn::And(x_y, hn::Ge(size[0], size[2]));
    y = hn::AndNot(x_y, hn::Ge(size[1], size[2]));
  }
  HWY_INLINE M is(int axis) const { return axis == 0 ? x : axis == 1 ? y : hn::Not(hn::Or(x, y)); }

  // Of a vector by axes, the k-th of the permuted axes, of which the last is the largest.
  HWY_INLINE V permuted(const V (&of)[3], int k) const {
    return hn::IfThenElse(x, of[(k + 1) % 3], hn::IfThenElse(y, of[(k + 2) % 3], of[k]));
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
