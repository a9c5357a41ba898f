// SPDX-License-Identifier: Apache-2.0
// The ray's side of the slab test: what makes a plane's distance along the ray one multiply-add.
//
// The ray o + t d is between the planes n . p = pmin and n . p = pmax for t from the lesser to the
// greater of (p - n.o) r, r = 1 / (n.d). Rounding is covered by widening the slab by
//   e = 16 u (2 |o| + R),  u = 2^-24, R the scene's radius, |n| = 1:
//   n.o   4 u |o|         (3 u for the dot product, u for o - c)
//   n.d   3 u (|o| + R)   (t |d| <= |o| + R for a point of the scene; the sign may be wrong, the
//                          widened interval still holds the point)
//   the products and sums below   5 u |o| + 4 u R
//   the triangle test's own rounding of vertices and t   3.5 u (|o| + R)  (triangle_test.h)
// So near = p_near r + (-n.o r - e |r|) and far = p_far r + (-n.o r + e |r|): the careful test
// costs what the careless one does. The idea is T. Ize's, "Robust BVH Ray Traversal" (2013).
#if defined(SOBB_TRACE_RAY_SLAB_COEFFICIENTS_INL_H) == \
    defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_RAY_SLAB_COEFFICIENTS_INL_H
#undef SOBB_TRACE_RAY_SLAB_COEFFICIENTS_INL_H
#else
#define SOBB_TRACE_RAY_SLAB_COEFFICIENTS_INL_H
#endif

#include <hwy/highway.h>

#include <bit>

#include "bounds/directions/direction_table.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// n . d is kept this far from zero, so that r is finite.
constexpr float kSmallestCosine = 0x1p-60F;

template <class V>
struct SlabCoefficients {
  V reciprocal;
  V near;
  V far;
};

// Directions, or rays, vary over the lanes.
template <class D, class V = hn::Vec<D>>
HWY_INLINE SlabCoefficients<V> slab_coefficients(D d, V nx, V ny, V nz, V ox, V oy, V oz, V dx,
                                                 V dy, V dz, V error) {
  const V no = hn::MulAdd(nz, oz, hn::MulAdd(ny, oy, hn::Mul(nx, ox)));
  const V nd = hn::MulAdd(nz, dz, hn::MulAdd(ny, dy, hn::Mul(nx, dx)));
  const V away = hn::CopySign(hn::Max(hn::Abs(nd), hn::Set(d, kSmallestCosine)), nd);
  const V r = hn::Div(hn::Set(d, 1.0F), away);
  const V slack = hn::Mul(error, hn::Abs(r));
  return {r, hn::NegMulSub(no, r, slack), hn::NegMulAdd(no, r, slack)};
}

// One ray, a ScaledRay or SlabRay, along directions over the lanes.
template <class D, class Ray, class V = hn::Vec<D>>
HWY_INLINE SlabCoefficients<V> slab_coefficients(D d, V nx, V ny, V nz, const Ray& ray) {
  return slab_coefficients(d, nx, ny, nz, hn::Set(d, ray.origin[0]), hn::Set(d, ray.origin[1]),
                           hn::Set(d, ray.origin[2]), hn::Set(d, ray.direction[0]),
                           hn::Set(d, ray.direction[1]), hn::Set(d, ray.direction[2]),
                           hn::Set(d, ray.error));
}

// One ray along three directions, whose components are the first of four each (the fourth is
// padding). Writes four numbers to each of `reciprocal`, `near` and `far`, aligned to 16 bytes.
template <class Ray>
HWY_INLINE void three_slab_coefficients(const float* x, const float* y, const float* z,
                                        const Ray& ray, float* reciprocal, float* near,
                                        float* far) {
  const hn::CappedTag<float, 4> d;
  const auto c = slab_coefficients(d, hn::Load(d, x), hn::Load(d, y), hn::Load(d, z), ray);
  hn::Store(c.reciprocal, d, reciprocal);
  hn::Store(c.near, d, near);
  hn::Store(c.far, d, far);
}

// 1 where the ray falls along the direction, so that the slab's upper plane is the near one, else
// 0. The reciprocal is never zero.
inline uint32_t falls_along(float reciprocal) { return std::bit_cast<uint32_t>(reciprocal) >> 31; }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
