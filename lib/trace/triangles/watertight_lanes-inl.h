// SPDX-License-Identifier: Apache-2.0
// The test of triangle_test.h in lanes, over which triangles vary or rays: the same operations in
// the same order as intersect_triangle(), so that it returns the same bits.
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

// A vertex's coordinate projected along the ray, rounded to float.
template <class D>
HWY_INLINE hn::Vec<D> project(D d, hn::Vec<D> at, hn::Vec<D> shear, hn::Vec<D> depth) {
  const hn::Rebind<float, D> df;
  return hn::PromoteTo(d, hn::DemoteTo(df, hn::Sub(at, hn::Mul(shear, depth))));
}

// The weights of the vertices, from their projections, and the lanes that are inside.
template <class D>
struct TriangleWeights {
  using V = hn::Vec<D>;
  V w[3];
  hn::Mask<D> inside;

  HWY_INLINE TriangleWeights(D d, const V (&x)[3], const V (&y)[3]) {
    w[0] = hn::Sub(hn::Mul(x[2], y[1]), hn::Mul(y[2], x[1]));
    w[1] = hn::Sub(hn::Mul(x[0], y[2]), hn::Mul(y[0], x[2]));
    w[2] = hn::Sub(hn::Mul(x[1], y[0]), hn::Mul(y[1], x[0]));
    // Where a weight is not a number, from overflow, t is not either.
    const V zero = hn::Zero(d);
    inside = hn::Or(hn::Ge(hn::Min(hn::Min(w[0], w[1]), w[2]), zero),
                    hn::Le(hn::Max(hn::Max(w[0], w[1]), w[2]), zero));
  }
};

// Where rays meet triangles' planes, and the lanes that hit the triangles themselves, ahead.
template <class D>
struct TriangleDistances {
  using V = hn::Vec<D>;
  V sum;  // of the weights
  V t;
  hn::Mask<D> hit;

  // `z` are the vertices' depths.
  HWY_INLINE TriangleDistances(D d, const TriangleWeights<D>& of, const V (&z)[3], V direction_z) {
    sum = hn::Add(hn::Add(of.w[0], of.w[1]), of.w[2]);
    t = hn::Div(
        hn::Add(hn::Add(hn::Mul(of.w[0], z[0]), hn::Mul(of.w[1], z[1])), hn::Mul(of.w[2], z[2])),
        hn::Mul(sum, direction_z));
    const V zero = hn::Zero(d);
    hit = hn::And(hn::And(of.inside, hn::Ne(sum, zero)), hn::Ge(t, zero));
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
