// SPDX-License-Identifier: Apache-2.0
// Rays over the lanes of vectors: one ray per lane, one vector per component.
#if defined(SOBB_TRACE_RAY_RAY_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
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

// Rays of a vector at most. Twice as many on 512-bit vectors were not measured yet.
inline constexpr size_t kMaxRayLanes = 8;
using RayFloats = hn::CappedTag<float, kMaxRayLanes>;
using RayWords = hn::RebindToUnsigned<RayFloats>;
inline constexpr uint32_t kRayLanes = hn::MaxLanes(RayFloats());

// Returns whether all three components of vectors are finite, given their magnitudes.
HWY_INLINE hn::Mask<RayFloats> are_finite(const hn::Vec<RayFloats> (&size)[3]) {
  const RayFloats d;
  const auto most = hn::Set(d, FLT_MAX);
  return hn::And(hn::And(hn::Le(size[0], most), hn::Le(size[1], most)), hn::Le(size[2], most));
}

struct RayVectors {
  using V = hn::Vec<RayFloats>;
  using M = hn::Mask<RayFloats>;

  V origin[3];
  V direction[3];
  V tmin;
  V tmax;

  HWY_INLINE explicit RayVectors(const sobb_ray* rays) {
    static_assert(sizeof(sobb_ray) == 8 * sizeof(float));
    const RayFloats d;
    // Half as many rays per load: origins come in even lanes, directions in odd ones.
    V a[4];
    V b[4];
    const float* at = rays->origin;
    hn::LoadInterleaved4(d, at, a[0], a[1], a[2], a[3]);
    hn::LoadInterleaved4(d, at + 4 * kRayLanes, b[0], b[1], b[2], b[3]);
    for (int k = 0; k < 3; ++k) {
      origin[k] = hn::ConcatEven(d, b[k], a[k]);
      direction[k] = hn::ConcatOdd(d, b[k], a[k]);
    }
    tmin = hn::ConcatEven(d, b[3], a[3]);
    tmax = hn::ConcatOdd(d, b[3], a[3]);
  }

  // The three parts of validity (validity.h): the interval, the direction and the origin.
  HWY_INLINE M has_valid_interval() const {
    return hn::And(hn::Ge(tmin, hn::Zero(RayFloats())), hn::Eq(tmax, tmax));
  }
  // `size` are the magnitudes of the direction's components, `largest` the largest of them.
  static HWY_INLINE M has_valid_direction(const V (&size)[3], V largest) {
    return hn::And(are_finite(size), hn::Gt(largest, hn::Zero(RayFloats())));
  }
  HWY_INLINE M has_valid_origin() const {
    return are_finite({hn::Abs(origin[0]), hn::Abs(origin[1]), hn::Abs(origin[2])});
  }
};

// The axis along which each direction is largest, as TriangleRay chooses it.
struct LargestAxis {
  using V = hn::Vec<RayFloats>;
  using M = hn::Mask<RayFloats>;

  M x;
  M y;

  // `size` are the magnitudes of the components.
  HWY_INLINE explicit LargestAxis(const V (&size)[3]) {
    const auto x_y = hn::Ge(size[0], size[1]);
    x = hn::And(x_y, hn::Ge(size[0], size[2]));
    y = hn::AndNot(x_y, hn::Ge(size[1], size[2]));
  }
  HWY_INLINE M is(int axis) const { return axis == 0 ? x : axis == 1 ? y : hn::Not(hn::Or(x, y)); }

  // The component of a vector along the k-th permuted axis, of which the last is the largest.
  HWY_INLINE V permuted(const V (&of)[3], int k) const {
    return hn::IfThenElse(x, of[(k + 1) % 3], hn::IfThenElse(y, of[(k + 2) % 3], of[k]));
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
