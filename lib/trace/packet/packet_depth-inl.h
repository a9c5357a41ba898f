// SPDX-License-Identifier: Apache-2.0
// A packet's depth from a ray's t, rounded to the safe side.
#if defined(SOBB_TRACE_PACKET_PACKET_DEPTH_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_PACKET_PACKET_DEPTH_INL_H
#undef SOBB_TRACE_PACKET_PACKET_DEPTH_INL_H
#else
#define SOBB_TRACE_PACKET_PACKET_DEPTH_INL_H
#endif

#include <hwy/highway.h>

#include "trace/ray/ray_vectors-inl.h"
#include "trace/ray/scaled_ray.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// A denormal t was rounded by as much as it is (scaled_ray.h), which is much where the direction is
// long.
template <class V>
HWY_INLINE V depth_before(RayFloats d, V t, V depth_of_one) {
  const V least = hn::Max(hn::Sub(t, hn::Set(d, kSmallestFloat)), hn::Zero(d));
  const V depth = hn::Mul(hn::Mul(least, depth_of_one), hn::Set(d, 1 - 0x1p-21F));
  return hn::Max(hn::Sub(depth, hn::Set(d, 0x1p-100F)), hn::Zero(d));
}
template <class V>
HWY_INLINE V depth_beyond(RayFloats d, V t, V depth_of_one) {
  const V most = hn::Add(t, hn::Set(d, kSmallestFloat));
  const V depth = hn::Mul(hn::Mul(most, depth_of_one), hn::Set(d, 1 + 0x1p-21F));
  return hn::Add(depth, hn::Set(d, 0x1p-100F));
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
