// SPDX-License-Identifier: Apache-2.0
// The formulas of triangle_test.h in lanes, over which triangles vary or rays: the same operations
// in the same order as intersect_triangle(), so that they give the same bits.
//
// They take vectors one by one: of structs and arrays of vectors GCC 12 keeps copies in memory (one
// ray per call: 1.05 times the instructions).
#if defined(SOBB_TRACE_TRIANGLES_WATERTIGHT_LANES_INL_H) == \
    defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_TRIANGLES_WATERTIGHT_LANES_INL_H
#undef SOBB_TRACE_TRIANGLES_WATERTIGHT_LANES_INL_H
#else
#define SOBB_TRACE_TRIANGLES_WATERTIGHT_LANES_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Projects a vertex's coordinate along the ray, and rounds it to float.
template <class D>
HWY_INLINE hn::Vec<D> project(D d, hn::Vec<D> at, hn::Vec<D> shear, hn::Vec<D> depth) {
  const hn::Rebind<float, D> df;
  return hn::PromoteTo(d, hn::DemoteTo(df, hn::Sub(at, hn::Mul(shear, depth))));
}

// Returns the weight of the third vertex, from the projections of two.
template <class V>
HWY_INLINE V vertex_weight(V ax, V ay, V bx, V by) {
  return hn::Sub(hn::Mul(ax, by), hn::Mul(ay, bx));
}

// Returns whether the ray goes through the triangle, by the weights. Where one is not a number,
// from overflow, t is not either.
template <class D>
HWY_INLINE hn::Mask<D> is_inside(D d, hn::Vec<D> w0, hn::Vec<D> w1, hn::Vec<D> w2) {
  const auto zero = hn::Zero(d);
  return hn::Or(hn::Ge(hn::Min(hn::Min(w0, w1), w2), zero),
                hn::Le(hn::Max(hn::Max(w0, w1), w2), zero));
}

// Returns where the ray meets the triangle's plane, from the weights, their sum and the vertices'
// depths.
template <class V>
HWY_INLINE V hit_distance(V w0, V w1, V w2, V sum, V z0, V z1, V z2, V direction_z) {
  return hn::Div(hn::Add(hn::Add(hn::Mul(w0, z0), hn::Mul(w1, z1)), hn::Mul(w2, z2)),
                 hn::Mul(sum, direction_z));
}

// Returns whether what is inside is a hit: the triangle is ahead, and not seen edge-on.
template <class D>
HWY_INLINE hn::Mask<D> is_hit(D d, hn::Mask<D> inside, hn::Vec<D> sum, hn::Vec<D> t) {
  const auto zero = hn::Zero(d);
  return hn::And(hn::And(inside, hn::Ne(sum, zero)), hn::Ge(t, zero));
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
