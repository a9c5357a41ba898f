// SPDX-License-Identifier: Apache-2.0
// A conservative test in float of a bundle of rays before one triangle, in front of the deciding
// test (triangle_test.h), which takes one ray at a time. It tells rays that surely miss, and in
// any-hit queries rays that surely hit.
//
// Let the triangle have corners v0, v1, v2, edges e1 = v1 - v0 and e2 = v2 - v0, and N = e1 x e2,
// and for the ray O + t D let C = v0 - O and R = C x D. Then the edge functions are
//   w20 = R . e2,  w01 = -R . e1,  w12 = N . D - w20 - w01,   and t = N . C / N . D
// (T. Moller, B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997).
//
// The deciding test has them for corners that moved by at most d = 2.9 u S, since it rounds their
// projections; u = 2^-24, S is no less than a corner's distance from the origin or from the scene's
// centre. With E = |e1| + |e2| that changes edge functions by 2 d |R| + 3 d |D| E + 2 d^2 |D|.
// Where it finds a hit, the hit is between the corners, which have one N . C, so that t N . D is
// off by no more than d |N|, however narrow the triangle. The ray's e (slab_coefficients-inl.h) is
// no less than 16 u S. With it and the rounding here
//   edge functions err by less than  |R| (e / 2 + 8 u E) + |D| (E (7/8 e + 3 u E) + e^2 / 8),
//   N . D by                         2 u E^2 |D|,
//   N . C by                         |N| e / 2 + u |C| (3 |N| + E^2),
// and what underflows by less than 2^-120. Lengths but |N| are sums of magnitudes. Where e or the
// ray's scale is not usual, so that something might overflow, nothing is sure.
#if defined(SOBB_TRACE_BATCH_LEAF_FILTER_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_BATCH_LEAF_FILTER_INL_H
#undef SOBB_TRACE_BATCH_LEAF_FILTER_INL_H
#else
#define SOBB_TRACE_BATCH_LEAF_FILTER_INL_H
#endif

#include <hwy/highway.h>

#include "base/simd/mask_bits-inl.h"
#include "format/layout.h"
#include "trace/batch/ray_bundle-inl.h"
#include "trace/ray/query.h"
#include "trace/ray/scaled_ray.h"
#include "trace/trace.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

template <class V>
HWY_INLINE V dot(const V (&a)[3], const V (&b)[3]) {
  return hn::MulAdd(a[2], b[2], hn::MulAdd(a[1], b[1], hn::Mul(a[0], b[0])));
}
template <class V>
HWY_INLINE void cross(const V (&a)[3], const V (&b)[3], V (&to)[3]) {
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    to[k] = hn::MulSub(a[i], b[j], hn::Mul(a[j], b[i]));
  }
}
// The sum of the components' magnitudes.
template <class V>
HWY_INLINE V size_of(const V (&a)[3]) {
  return hn::Add(hn::Add(hn::Abs(a[0]), hn::Abs(a[1])), hn::Abs(a[2]));
}

// What underflows in the sums of products below changes them by less.
inline constexpr float kUnderflow = 0x1p-120F;

// What the filter needs of the four triangles of a block.
struct FilterBlock {
  alignas(16) float corner[3][4];  // v0, from the scene's centre
  alignas(16) float edge1[3][4];
  alignas(16) float edge2[3][4];
  alignas(16) float normal[3][4];
  alignas(16) float size[4];          // E
  alignas(16) float normal_size[4];   // |N|
  alignas(16) float normal_error[4];  // u (3 |N| + E^2)

  HWY_INLINE void make(const TraceScene& scene, const TriangleBlock& block) {
    const hn::CappedTag<float, 4> d;
    using V = hn::Vec<decltype(d)>;
    V e1[3];
    V e2[3];
    V n[3];
    for (int k = 0; k < 3; ++k) {
      const V v0 = hn::Load(d, block.vertex[0][k]);
      e1[k] = hn::Sub(hn::Load(d, block.vertex[1][k]), v0);
      e2[k] = hn::Sub(hn::Load(d, block.vertex[2][k]), v0);
      hn::Store(hn::Sub(v0, hn::Set(d, scene.centre[k])), d, corner[k]);
      hn::Store(e1[k], d, edge1[k]);
      hn::Store(e2[k], d, edge2[k]);
    }
    cross(e1, e2, n);
    for (int k = 0; k < 3; ++k) hn::Store(n[k], d, normal[k]);
    const V of_edges = hn::Add(size_of(e1), size_of(e2));
    const V of_normal = hn::Sqrt(dot(n, n));
    hn::Store(of_edges, d, size);
    hn::Store(of_normal, d, normal_size);
    const V thrice = hn::Mul(of_normal, hn::Set(d, 3.0F));
    hn::Store(hn::Mul(hn::MulAdd(of_edges, of_edges, thrice), hn::Set(d, kUnit)), d, normal_error);
  }
};

// What the filter needs of a bundle.
struct FilterRays {
  using V = hn::Vec<RayFloats>;

  V origin[3];
  V direction[3];
  V tmin;
  V limit;
  V error;
  V speed;  // |D|
  V least;  // e^2 |D| / 8, and what underflows

  HWY_INLINE explicit FilterRays(const RayBundle& bundle) : tmin(bundle.tmin), limit(bundle.limit) {
    const RayFloats d;
    V scale;
    bundle.load(&SlabRay::origin, origin, scale);
    bundle.load(&SlabRay::direction, direction, error);
    const auto usual = hn::And(hn::Le(error, hn::Set(d, 0x1p12F)), hn::Eq(scale, hn::Set(d, 1.0F)));
    error = hn::IfThenElse(usual, error, hn::Set(d, INFINITY));
    speed = size_of(direction);
    least = hn::MulAdd(hn::Mul(hn::Mul(error, error), hn::Set(d, 0.125F)), speed,
                       hn::Set(d, kUnderflow));
  }
};

// What is known of a bundle's rays before a triangle, one bit per ray.
struct FilterVerdict {
  uint32_t may_hit;  // those that surely hit are among them
  uint32_t hits;     // surely; not told in closest-hit queries
};

// One triangle of a block, the same in all lanes.
struct FilterTriangle {
  using V = FilterRays::V;
  V corner[3];
  V edge1[3];
  V edge2[3];
  V normal[3];
  V size;
  V normal_size;
  V normal_error;

  HWY_INLINE FilterTriangle(const FilterBlock& block, uint32_t i) {
    const RayFloats d;
    for (int k = 0; k < 3; ++k) {
      corner[k] = hn::Set(d, block.corner[k][i]);
      edge1[k] = hn::Set(d, block.edge1[k][i]);
      edge2[k] = hn::Set(d, block.edge2[k][i]);
      normal[k] = hn::Set(d, block.normal[k][i]);
    }
    size = hn::Set(d, block.size[i]);
    normal_size = hn::Set(d, block.normal_size[i]);
    normal_error = hn::Set(d, block.normal_error[i]);
  }
};

// What the edge functions of a triangle make sure, given its C and N . D.
struct EdgeVerdict {
  hn::Mask<RayFloats> outside;
  hn::Mask<RayFloats> inside;
};
template <class V>
HWY_INLINE EdgeVerdict test_edges(const FilterRays& rays, const FilterTriangle& triangle,
                                  const V (&c)[3], V across) {
  const RayFloats d;
  V r[3];
  cross(c, rays.direction, r);
  const V w20 = dot(r, triangle.edge2);
  const V w10 = dot(r, triangle.edge1);
  const V w01 = hn::Neg(w10);
  const V w12 = hn::Add(hn::Sub(across, w20), w10);
  const V lowest = hn::Min(hn::Min(w20, w01), w12);
  const V highest = hn::Max(hn::Max(w20, w01), w12);
  const V size = triangle.size;
  const V of_r = hn::MulAdd(size, hn::Set(d, 8 * kUnit), hn::Mul(rays.error, hn::Set(d, 0.5F)));
  const V of_d = hn::MulAdd(size, hn::Set(d, 3 * kUnit), hn::Mul(rays.error, hn::Set(d, 0.875F)));
  const V slack =
      hn::MulAdd(size_of(r), of_r, hn::MulAdd(hn::Mul(rays.speed, size), of_d, rays.least));
  const V minus_slack = hn::Neg(slack);
  return {hn::And(hn::Lt(lowest, minus_slack), hn::Gt(highest, slack)),
          hn::Or(hn::Gt(lowest, slack), hn::Lt(highest, minus_slack))};
}

// What its plane makes sure: t = depth / steepness, where the ray surely crosses it.
struct PlaneVerdict {
  hn::Mask<RayFloats> crosses;
  hn::Mask<RayFloats> beyond;  // the ray's interval, or before the origin
  hn::Mask<RayFloats> within;  // the interval
};
template <class V>
HWY_INLINE PlaneVerdict test_plane(const FilterRays& rays, const FilterTriangle& triangle,
                                   const V (&c)[3], V across) {
  const RayFloats d;
  const V steepness = hn::Abs(across);
  const V depth = hn::Xor(dot(triangle.normal, c), hn::And(across, hn::Set(d, -0.0F)));
  const V of_steepness =
      hn::MulAdd(hn::Mul(rays.speed, triangle.size), hn::Mul(triangle.size, hn::Set(d, 2 * kUnit)),
                 hn::Set(d, kUnderflow));
  const V of_depth =
      hn::MulAdd(triangle.normal_size, hn::Mul(rays.error, hn::Set(d, 0.5F)),
                 hn::MulAdd(size_of(c), triangle.normal_error, hn::Set(d, kUnderflow)));
  const V least_depth = hn::Sub(depth, of_depth);
  const V most_depth = hn::Add(depth, of_depth);
  const V least_steepness = hn::Sub(steepness, of_steepness);
  const V most_steepness = hn::Add(steepness, of_steepness);
  // t is rounded to float, and may be as little as the least float off its interval's ends.
  const V first = hn::MulAdd(rays.tmin, hn::Set(d, 1 + 0x1p-20F), hn::Set(d, 0x1p-100F));
  const V last = hn::Mul(rays.limit, hn::Set(d, 1 - 0x1p-20F));
  const V behind = hn::Mul(rays.limit, hn::Set(d, 1 + 0x1p-20F));
  return {
      hn::Gt(steepness, of_steepness),
      hn::Or(hn::Lt(most_depth, hn::Zero(d)), hn::Gt(least_depth, hn::Mul(behind, most_steepness))),
      hn::And(hn::Gt(least_depth, hn::Mul(first, most_steepness)),
              hn::Lt(most_depth, hn::Mul(last, least_steepness)))};
}

template <Query kQuery>
HWY_INLINE FilterVerdict filter(const FilterRays& rays, const FilterBlock& block, uint32_t i) {
  const RayFloats d;
  const FilterTriangle triangle(block, i);
  FilterRays::V c[3];
  for (int k = 0; k < 3; ++k) c[k] = hn::Sub(triangle.corner[k], rays.origin[k]);
  const auto across = dot(triangle.normal, rays.direction);
  const EdgeVerdict edges = test_edges(rays, triangle, c, across);
  const PlaneVerdict plane = test_plane(rays, triangle, c, across);
  const auto missed = hn::Or(edges.outside, hn::And(plane.crosses, plane.beyond));
  FilterVerdict verdict = {mask_bits(d, missed) ^ all_lanes(d), 0};
  if constexpr (kQuery == Query::kAny) {
    verdict.hits = mask_bits(d, hn::And(hn::And(edges.inside, plane.crosses), plane.within));
  }
  return verdict;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
