// SPDX-License-Identifier: Apache-2.0
// Rays made ready for the kernels that trace many: as many at once as a vector has lanes.
//
// A class `Places` says where the parts of a ray go, by the ray's number i:
//   slabs(i)                 its SlabRay
//   begin_hit(i, ray)        starts its closest hit
//   begin_triangles(i, tmin, largest, origin, shear, dz)   starts what it needs before triangles,
//                            from the parts of a TriangleRay; called where kTriangleRays
#if defined(SOBB_TRACE_RAY_RAY_SETUP_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_RAY_RAY_SETUP_INL_H
#undef SOBB_TRACE_RAY_RAY_SETUP_INL_H
#else
#define SOBB_TRACE_RAY_RAY_SETUP_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "base/simd/mask_bits-inl.h"
#include "base/simd/transpose-inl.h"
#include "trace/ray/ray_vectors-inl.h"
#include "trace/ray/scaled_ray.h"
#include "trace/ray/slab_coefficients-inl.h"
#include "trace/ray/slab_ray.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Facts about rays that were made ready, one bit per ray.
struct RayFacts {
  uint32_t valid;
  uint32_t falls[3];  // along the table's first three directions
};

template <class Places>
class RaySetup {
 public:
  RaySetup(const TraceScene& scene, Places places) : scene_(scene), places_(places) {}

  // Makes `count` rays ready, at most as many as a vector has lanes, the first as number i. The
  // places of all lanes are written.
  HWY_INLINE RayFacts make(const sobb_ray* rays, uint32_t count, uint32_t i) {
    if (count == kRayLanes) return make_lanes(rays, i);
    sobb_ray all[kRayLanes];
    for (uint32_t lane = 0; lane < kRayLanes; ++lane) all[lane] = rays[std::min(lane, count - 1)];
    RayFacts facts = make_lanes(all, i);
    facts.valid &= low_bits(count);
    return facts;
  }

 private:
  using V = RayVectors::V;

  HWY_INLINE RayFacts make_lanes(const sobb_ray* rays, uint32_t i) {
    RayFacts facts;
    const RayFloats d;
    const RayVectors some(rays);
    V size[3];
    for (int k = 0; k < 3; ++k) size[k] = hn::Abs(some.direction[k]);
    const V largest = hn::Max(hn::Max(size[0], size[1]), size[2]);
    const auto valid = hn::And(hn::And(some.has_valid_interval(), some.has_valid_origin()),
                               RayVectors::has_valid_direction(size, largest));
    facts.valid = mask_bits(d, valid);

    V origin[3];
    for (int k = 0; k < 3; ++k) origin[k] = hn::Sub(some.origin[k], hn::Set(d, scene_.centre[k]));
    const V distance = hn::Add(hn::Add(hn::Abs(origin[0]), hn::Abs(origin[1])), hn::Abs(origin[2]));
    constexpr float kLongest = ScaledRay::kLongest;
    const auto usual = hn::And(
        hn::And(hn::Ge(largest, hn::Set(d, 1 / kLongest)), hn::Le(largest, hn::Set(d, kLongest))),
        hn::Le(distance, hn::Set(d, ScaledRay::kFurthest)));
    make_slab_rays(some, origin, distance, i, facts.falls);
    if constexpr (Places::kTriangleRays) make_triangle_rays(some, LargestAxis(size), i);
    for (uint32_t lane = 0; lane < kRayLanes; ++lane) places_.begin_hit(i + lane, rays[lane]);
    for (uint32_t left = facts.valid & ~mask_bits(d, usual); left != 0; left &= left - 1) {
      const auto lane = static_cast<uint32_t>(std::countr_zero(left));
      SlabRay& slabs = places_.slabs(i + lane);
      make_slab_ray(ScaledRay(scene_, rays[lane]), rays[lane].tmax, slabs);
      for (int j = 0; j < 3; ++j) {
        const uint32_t falls = falls_along(slabs.reciprocal[j]);
        facts.falls[j] = (facts.falls[j] & ~(1U << lane)) | falls << lane;
      }
    }
    return facts;
  }

  // Makes the SlabRays as ScaledRay has them where nothing need be scaled.
  HWY_INLINE void make_slab_rays(const RayVectors& rays, const V (&origin)[3], V distance,
                                 uint32_t i, uint32_t (&falls)[3]) {
    const RayFloats d;
    const V reach = hn::Add(distance, hn::Set(d, scene_.radius));
    const V error = hn::MulAdd(hn::Add(distance, reach), hn::Set(d, ScaledRay::kRelativeError),
                               hn::Set(d, ScaledRay::kLeastError));
    const V tmin = hn::Max(hn::Sub(rays.tmin, hn::Set(d, kSmallestFloat)), hn::Zero(d));
    const DirectionTable& directions = scene_.directions;
    SlabCoefficients<V> c[3];
    for (int j = 0; j < 3; ++j) {
      c[j] = slab_coefficients(d, hn::Set(d, directions.x[j]), hn::Set(d, directions.y[j]),
                               hn::Set(d, directions.z[j]), origin[0], origin[1], origin[2],
                               rays.direction[0], rays.direction[1], rays.direction[2], error);
      falls[j] = mask_bits(d, hn::Lt(c[j].reciprocal, hn::Zero(d)));
    }
    SlabRay* to[kRayLanes];
    for (uint32_t lane = 0; lane < kRayLanes; ++lane) to[lane] = &places_.slabs(i + lane);
    const V limit = hn::Add(hn::Min(rays.tmax, hn::Set(d, FLT_MAX)), hn::Set(d, kSmallestFloat));
    // Four numbers of each ray: a member of its SlabRay and the one behind it.
    const auto store = [&](V a, V b, V c, V e, float(SlabRay::*member)[3]) HWY_ATTR {
      store_columns(d, a, b, c, e, [&](uint32_t lane) { return to[lane]->*member; });
    };
    store(c[0].reciprocal, c[1].reciprocal, c[2].reciprocal, tmin, &SlabRay::reciprocal);
    store(c[0].near, c[1].near, c[2].near, limit, &SlabRay::near);
    store(c[0].far, c[1].far, c[2].far, hn::Zero(d), &SlabRay::far);
    store(origin[0], origin[1], origin[2], hn::Set(d, 1.0F), &SlabRay::origin);
    store(rays.direction[0], rays.direction[1], rays.direction[2], error, &SlabRay::direction);
  }

  // Makes one SlabRay, whatever the ray's size.
  HWY_INLINE void make_slab_ray(const ScaledRay& ray, float tmax, SlabRay& to) {
    const DirectionTable& directions = scene_.directions;
    three_slab_coefficients(directions.x, directions.y, directions.z, ray, to.reciprocal, to.near,
                            to.far);
    to.tmin = ray.tmin;
    to.scale = ray.scale;
    to.error = ray.error;
    for (int k = 0; k < 3; ++k) {
      to.origin[k] = ray.origin[k];
      to.direction[k] = ray.direction[k];
    }
    to.limit = scale_limit(std::min(tmax, FLT_MAX), ray.scale);
  }

  // Makes the parts of TriangleRays.
  HWY_INLINE void make_triangle_rays(const RayVectors& rays, const LargestAxis& axis, uint32_t i) {
    const RayFloats d;
    alignas(64) double origin[3][kRayLanes];
    alignas(64) double shear[2][kRayLanes];
    alignas(64) double along[kRayLanes];
    alignas(64) float tmin[kRayLanes];
    for (int k = 0; k < 3; ++k) store_doubles(axis.permuted(rays.origin, k), origin[k]);
    const V z = axis.permuted(rays.direction, 2);
    for (int k = 0; k < 2; ++k) store_quotients(axis.permuted(rays.direction, k), z, shear[k]);
    store_doubles(z, along);
    hn::Store(rays.tmin, d, tmin);
    const uint32_t x = mask_bits(d, axis.x);
    const uint32_t y = mask_bits(d, axis.y);
    for (uint32_t lane = 0; lane < kRayLanes; ++lane) {
      const int largest = (x >> lane & 1) != 0 ? 0 : 2 - static_cast<int>(y >> lane & 1);
      const double from[3] = {origin[0][lane], origin[1][lane], origin[2][lane]};
      const double shears[2] = {shear[0][lane], shear[1][lane]};
      places_.begin_triangles(i + lane, tmin[lane], largest, from, shears, along[lane]);
    }
  }

  using HalfFloats = hn::Half<RayFloats>;
  using HalfDoubles = hn::Rebind<double, HalfFloats>;

  static HWY_INLINE void store_doubles(V v, double* to) {
    const HalfDoubles d;
    hn::Store(hn::PromoteTo(d, hn::LowerHalf(HalfFloats(), v)), d, to);
    hn::Store(hn::PromoteTo(d, hn::UpperHalf(HalfFloats(), v)), d, to + kRayLanes / 2);
  }
  static HWY_INLINE void store_quotients(V a, V b, double* to) {
    const HalfFloats half;
    const HalfDoubles d;
    const auto quotient = [&](auto x, auto y) HWY_ATTR {
      return hn::Div(hn::PromoteTo(d, x), hn::PromoteTo(d, y));
    };
    hn::Store(quotient(hn::LowerHalf(half, a), hn::LowerHalf(half, b)), d, to);
    hn::Store(quotient(hn::UpperHalf(half, a), hn::UpperHalf(half, b)), d, to + kRayLanes / 2);
  }

  const TraceScene& scene_;
  Places places_;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
