// SPDX-License-Identifier: Apache-2.0
// Rays made ready for kernels that trace many: as many at once as a vector has lanes. Included once
// for each Highway target.
//
// Where each is to go, `Places` says, by functions of the ray's number:
//   slabs(i)       its SlabRay
//   hit(i)         memory for its ClosestHit
//   block_ray(i)   memory for its BlockRay, if kBlockRays says that it is to be made
#if defined(SOBB_TRACE_RAY_RAY_SETUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_RAY_RAY_SETUP_INL_H
#undef SOBB_TRACE_RAY_RAY_SETUP_INL_H
#else
#define SOBB_TRACE_RAY_RAY_SETUP_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <new>

#include "base/simd/mask_bits-inl.h"
#include "base/simd/transpose-inl.h"
#include "trace/ray/ray_vectors-inl.h"
#include "trace/ray/scaled_ray.h"
#include "trace/ray/slab_ray.h"
#include "trace/triangles/watertight_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// What a filler says of the rays that it made, a bit each.
struct FilledRays {
  uint32_t valid;
  uint32_t falls[3];  // whose cosines with the first three directions are negative
};

template <class Places>
class RayFiller {
 public:
  RayFiller(const TraceScene& scene, Places places) : scene_(scene), places_(places) {}

  // Makes rays, at most as many as a vector has lanes, the first the i-th; the places of all lanes
  // are written.
  HWY_INLINE FilledRays fill(const sobb_ray* rays, uint32_t count, uint32_t i) {
    if (count == kLanes) return fill_lanes(rays, i);
    sobb_ray all[kLanes];
    for (uint32_t lane = 0; lane < kLanes; ++lane) all[lane] = rays[std::min(lane, count - 1)];
    FilledRays filled = fill_lanes(all, i);
    filled.valid &= (1U << count) - 1;
    return filled;
  }

 private:
  using V = RayVectors::V;
  using M = RayVectors::M;
  static constexpr uint32_t kLanes = RayVectors::kLanes;

  HWY_INLINE FilledRays fill_lanes(const sobb_ray* rays, uint32_t i) {
    FilledRays filled;
    const RayFloats d;
    const RayVectors some(rays);
    V size[3];
    for (int k = 0; k < 3; ++k) size[k] = hn::Abs(some.direction[k]);
    const V largest = hn::Max(hn::Max(size[0], size[1]), size[2]);
    filled.valid = mask_bits(d, is_valid(some, size, largest));

    V origin[3];
    for (int k = 0; k < 3; ++k) origin[k] = hn::Sub(some.origin[k], hn::Set(d, scene_.centre[k]));
    const V distance = hn::Add(hn::Add(hn::Abs(origin[0]), hn::Abs(origin[1])), hn::Abs(origin[2]));
    constexpr float kLongest = ScaledRay::kLongest;
    const auto usual = hn::And(
        hn::And(hn::Ge(largest, hn::Set(d, 1 / kLongest)), hn::Le(largest, hn::Set(d, kLongest))),
        hn::Le(distance, hn::Set(d, ScaledRay::kFurthest)));
    fill_slabs(some, origin, distance, i, filled.falls);
    if constexpr (Places::kBlockRays) fill_triangle_rays(some, LargestAxis(size), i);
    for (uint32_t lane = 0; lane < kLanes; ++lane) {
      new (places_.hit(i + lane)) ClosestHit(rays[lane]);
    }
    for (uint32_t left = filled.valid & ~mask_bits(d, usual); left != 0; left &= left - 1) {
      const auto lane = static_cast<uint32_t>(std::countr_zero(left));
      fill_slabs(ScaledRay(scene_, rays[lane]), i + lane);
      for (int j = 0; j < 3; ++j) {
        const uint32_t falls = std::bit_cast<uint32_t>(places_.slabs(i + lane).reciprocal[j]) >> 31;
        filled.falls[j] = (filled.falls[j] & ~(1U << lane)) | falls << lane;
      }
    }
    return filled;
  }

  // As is_valid() of one ray.
  static HWY_INLINE M is_valid(const RayVectors& rays, const V (&size)[3], V largest) {
    const RayFloats d;
    const V most = hn::Set(d, FLT_MAX);
    auto valid = hn::And(hn::Ge(rays.tmin, hn::Zero(d)), hn::Eq(rays.tmax, rays.tmax));
    valid = hn::And(valid, hn::Gt(largest, hn::Zero(d)));
    for (int k = 0; k < 3; ++k) {
      valid = hn::And(valid, hn::Le(size[k], most));
      valid = hn::And(valid, hn::Le(hn::Abs(rays.origin[k]), most));
    }
    return valid;
  }

  // As ScaledRay has them where nothing need be scaled.
  HWY_INLINE void fill_slabs(const RayVectors& rays, const V (&origin)[3], V distance, uint32_t i,
                             uint32_t (&falls)[3]) {
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
      falls[j] = mask_bits(d, hn::MaskFromVec(c[j].reciprocal));  // the sign bit alone
    }
    SlabRay* to[kLanes];
    for (uint32_t lane = 0; lane < kLanes; ++lane) to[lane] = &places_.slabs(i + lane);
    const V limit = hn::Add(hn::Min(rays.tmax, hn::Set(d, FLT_MAX)), hn::Set(d, kSmallestFloat));
    const V scale = hn::Set(d, 1.0F);
    store_rows(c[0].reciprocal, c[1].reciprocal, c[2].reciprocal, tmin, to, &SlabRay::reciprocal);
    store_rows(c[0].near, c[1].near, c[2].near, limit, to, &SlabRay::near);
    store_rows(c[0].far, c[1].far, c[2].far, hn::Zero(d), to, &SlabRay::far);
    store_rows(origin[0], origin[1], origin[2], scale, to, &SlabRay::origin);
    store_rows(rays.direction[0], rays.direction[1], rays.direction[2], error, to,
               &SlabRay::direction);
  }

  // Four numbers of each ray, to a member of its SlabRay and what follows it.
  template <class Vector, class Member>
  static HWY_INLINE void store_rows(Vector a, Vector b, Vector c, Vector e,
                                    SlabRay* const (&to)[kLanes], Member member) {
    const hn::CappedTag<float, 4> row;
    Vector column[4];
    transpose_blocks(a, b, c, e, column);
    for (size_t j = 0; j < 4; ++j) {
      if constexpr (kLanes == 4) {
        hn::Store(column[j], row, to[j]->*member);
      } else {
        hn::Store(hn::LowerHalf(row, column[j]), row, to[j]->*member);
        hn::Store(hn::UpperHalf(row, column[j]), row, to[j + 4]->*member);
      }
    }
  }

  // Of one ray, whatever its size. Its hit is there.
  HWY_INLINE void fill_slabs(const ScaledRay& ray, uint32_t i) {
    const hn::CappedTag<float, 4> d;
    const DirectionTable& directions = scene_.directions;
    const auto c = slab_coefficients(d, hn::Load(d, directions.x), hn::Load(d, directions.y),
                                     hn::Load(d, directions.z), hn::Set(d, ray.origin[0]),
                                     hn::Set(d, ray.origin[1]), hn::Set(d, ray.origin[2]),
                                     hn::Set(d, ray.direction[0]), hn::Set(d, ray.direction[1]),
                                     hn::Set(d, ray.direction[2]), hn::Set(d, ray.error));
    SlabRay& to = places_.slabs(i);
    hn::Store(c.reciprocal, d, to.reciprocal);
    hn::Store(c.near, d, to.near);
    hn::Store(c.far, d, to.far);
    to.tmin = ray.tmin;
    to.scale = ray.scale;
    to.error = ray.error;
    for (int k = 0; k < 3; ++k) {
      to.origin[k] = ray.origin[k];
      to.direction[k] = ray.direction[k];
    }
    const auto* best = std::launder(static_cast<const ClosestHit*>(places_.hit(i)));
    to.limit = scale_limit(best->limit, ray.scale);
  }

  // As TriangleRay has them.
  HWY_INLINE void fill_triangle_rays(const RayVectors& rays, const LargestAxis& axis, uint32_t i) {
    const RayFloats d;
    alignas(64) double origin[3][kLanes];
    alignas(64) double shear[2][kLanes];
    alignas(64) double along[kLanes];
    alignas(64) float tmin[kLanes];
    for (int k = 0; k < 3; ++k) store_doubles(axis.permuted(rays.origin, k), origin[k]);
    const V z = axis.permuted(rays.direction, 2);
    for (int k = 0; k < 2; ++k) store_quotients(axis.permuted(rays.direction, k), z, shear[k]);
    store_doubles(z, along);
    hn::Store(rays.tmin, d, tmin);
    const uint32_t x = mask_bits(d, axis.x);
    const uint32_t y = mask_bits(d, axis.y);
    for (uint32_t lane = 0; lane < kLanes; ++lane) {
      const int largest = (x >> lane & 1) != 0 ? 0 : 2 - static_cast<int>(y >> lane & 1);
      const double from[3] = {origin[0][lane], origin[1][lane], origin[2][lane]};
      const double shears[2] = {shear[0][lane], shear[1][lane]};
      new (places_.block_ray(i + lane)) BlockRay(tmin[lane], largest, from, shears, along[lane]);
    }
  }

  using HalfFloats = hn::Half<RayFloats>;
  using HalfDoubles = hn::Rebind<double, HalfFloats>;

  static HWY_INLINE void store_doubles(V v, double* to) {
    const HalfDoubles d;
    hn::Store(hn::PromoteTo(d, hn::LowerHalf(HalfFloats(), v)), d, to);
    hn::Store(hn::PromoteTo(d, hn::UpperHalf(HalfFloats(), v)), d, to + kLanes / 2);
  }
  static HWY_INLINE void store_quotients(V a, V b, double* to) {
    const HalfFloats half;
    const HalfDoubles d;
    const auto quotient = [&](auto x, auto y) HWY_ATTR {
      return hn::Div(hn::PromoteTo(d, x), hn::PromoteTo(d, y));
    };
    hn::Store(quotient(hn::LowerHalf(half, a), hn::LowerHalf(half, b)), d, to);
    hn::Store(quotient(hn::UpperHalf(half, a), hn::UpperHalf(half, b)), d, to + kLanes / 2);
  }

  const TraceScene& scene_;
  Places places_;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
