// SPDX-License-Identifier: Apache-2.0
// The rays of a packet: of one origin, their directions largest along one axis with one sign, so
// that all share a projection. Included once for each Highway target.
//
// Depth is the distance along that axis; with it as the parameter, instead of t, a ray is
// o + depth (slope_x, slope_y, +-1) in the axes permuted as triangle_test.h does, and interval
// arithmetic on neighbouring rays bounds the frustum that they span, not much more.
// Neighbours share a lane: a packet has eight, of `kRun` rays each.
#if defined(SOBB_TRACE_PACKET_RAYS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_PACKET_RAYS_INL_H
#undef SOBB_TRACE_PACKET_RAYS_INL_H
#else
#define SOBB_TRACE_PACKET_RAYS_INL_H
#endif

#include <hwy/highway.h>

#include <bit>

#include "trace/mask_bits-inl.h"
#include "trace/scaled_ray.h"
#include "trace/triangle_test.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using RayFloats = hn::CappedTag<float, 8>;
using RayWords = hn::RebindToUnsigned<RayFloats>;

constexpr int kPacketLanes = 8;
constexpr int kAllLanes = kPacketLanes;  // index of what is of the whole packet, behind the lanes

// t in units of depth, rounded to the safe side. The slack is for denormal t.
template <class V>
HWY_INLINE V depth_before(RayFloats d, V t, V depth_of_one) {
  const V depth = hn::Mul(hn::Mul(t, depth_of_one), hn::Set(d, 1 - 0x1p-21F));
  return hn::Max(hn::Sub(depth, hn::Set(d, 0x1p-100F)), hn::Zero(d));
}
template <class V>
HWY_INLINE V depth_beyond(RayFloats d, V t, V depth_of_one) {
  const V depth = hn::Mul(hn::Mul(t, depth_of_one), hn::Set(d, 1 + 0x1p-21F));
  return hn::Add(depth, hn::Set(d, 0x1p-100F));
}

template <int kSize>
struct PacketRays {
  static constexpr int kRun = kSize / kPacketLanes;

  // What all share.
  TriangleRay frame;  // of the first ray: axes and origin
  ScaledRay centred;  // of the first ray: origin from the centre, reach and error
  float sign;         // of the directions along frame.axis[2]
  float centre[2];    // slopes in the middle of the packet
  float spread[2];    // no slope is further from there

  // By ray.
  alignas(64) double shear[2][kSize];  // as TriangleRay has them
  alignas(64) double direction_z[kSize];
  alignas(64) float slope[2][kSize];      // from `centre`
  alignas(64) float depth_of_one[kSize];  // depth at t = 1
  alignas(64) float tmin[kSize];
  alignas(64) float limit[kSize];  // t of the best hit so far; of an inactive ray negative
  alignas(64) float near[kSize];   // tmin as depth, or less
  alignas(64) float far[kSize];    // limit as depth, or more; of an inactive ray negative
  alignas(64) float u[kSize];
  alignas(64) float v[kSize];
  alignas(64) uint32_t primitive[kSize];

  // By lane, and then of all.
  alignas(64) float lane_near[kPacketLanes + 8];
  alignas(64) float lane_far[kPacketLanes + 8];
  // Slopes by place in the run, then lane.
  alignas(64) float lane_slope[2][kRun][kPacketLanes];

  explicit PacketRays(const TraceScene& scene, const sobb_ray& first)
      : frame(first), centred(scene, first), sign(frame.direction_z < 0 ? -1.0F : 1.0F) {}

  // Which rays are valid and share the first's origin, axis and sign; their data is then set.
  uint64_t take(const sobb_ray* rays, uint64_t mask);

  // The furthest that any ray of a lane still matters, where limits of some vectors changed.
  HWY_INLINE void update_lanes(uint32_t vectors) {
    const RayFloats d;
    constexpr int kStep = hn::MaxLanes(RayFloats());
    for (; vectors != 0; vectors &= vectors - 1) {
      const int first = std::countr_zero(vectors) * kStep;
      if constexpr (kRun == kStep) {
        lane_far[first / kRun] = hn::GetLane(hn::MaxOfLanes(d, hn::Load(d, far + first)));
      } else {
        const int begin = first / kRun;
        const int end = std::max(begin + 1, (first + kStep) / kRun);
        for (int lane = begin; lane < end; ++lane) {
          lane_far[lane] = *std::max_element(far + lane * kRun, far + (lane + 1) * kRun);
        }
      }
    }
    lane_far[kAllLanes] = *std::max_element(lane_far, lane_far + kPacketLanes);
  }
};

// From values by ray to values by place in the run, in any order, then lane: evens go before odds
// until a lane has one value.
template <int kCount>
HWY_INLINE void spread_runs(const float* from, float* to) {
  const RayFloats d;
  constexpr int kStep = hn::MaxLanes(RayFloats());
  constexpr int kHalf = kCount / 2;
  alignas(64) float parts[kCount];
  float* out = kHalf == kPacketLanes ? to : parts;
  for (int i = 0; i < kHalf; i += kStep) {
    const auto a = hn::Load(d, from + 2 * i);
    const auto b = hn::Load(d, from + 2 * i + kStep);
    hn::Store(hn::ConcatEven(d, b, a), d, out + i);
    hn::Store(hn::ConcatOdd(d, b, a), d, out + kHalf + i);
  }
  if constexpr (kHalf > kPacketLanes) {
    spread_runs<kHalf>(parts, to);
    spread_runs<kHalf>(parts + kHalf, to + kHalf);
  }
}

template <int kSize>
uint64_t PacketRays<kSize>::take(const sobb_ray* rays, uint64_t mask) {
  const RayFloats d;
  const RayWords dw;
  constexpr size_t kStep = hn::MaxLanes(RayFloats());
  const auto largest = hn::Set(d, FLT_MAX);
  const uint32_t first = static_cast<uint32_t>(std::countr_zero(mask));
  alignas(64) float direction[3][kSize];
  uint64_t taken = 0;
  for (size_t i = 0; i < kSize; i += kStep) {
    // Half as many rays at once: origins in even lanes, directions in odd ones.
    hn::Vec<RayFloats> a[4];
    hn::Vec<RayFloats> b[4];
    const float* at = rays[i].origin;
    hn::LoadInterleaved4(d, at, a[0], a[1], a[2], a[3]);
    hn::LoadInterleaved4(d, at + 4 * kStep, b[0], b[1], b[2], b[3]);
    auto same = hn::MaskFromVec(hn::BitCast(d, hn::Set(dw, 0xFFFFFFFF)));
    hn::Vec<RayFloats> size[3];
    for (int k = 0; k < 3; ++k) {
      const auto o = hn::ConcatEven(d, b[k], a[k]);
      const auto v = hn::ConcatOdd(d, b[k], a[k]);
      const auto expected = hn::Set(dw, std::bit_cast<uint32_t>(rays[first].origin[k]));
      same = hn::And(same, hn::RebindMask(d, hn::Eq(hn::BitCast(dw, o), expected)));
      hn::Store(v, d, direction[k] + i);
      size[k] = hn::Abs(v);
    }
    const auto t0 = hn::ConcatEven(d, b[3], a[3]);
    const auto t1 = hn::ConcatOdd(d, b[3], a[3]);
    hn::Store(t0, d, tmin + i);
    hn::Store(hn::Min(t1, largest), d, limit + i);
    const auto finite = hn::And(hn::Le(size[0], largest),
                                hn::And(hn::Le(size[1], largest), hn::Le(size[2], largest)));
    const auto times = hn::And(hn::Ge(t0, hn::Zero(d)), hn::Eq(t1, t1));
    const auto along = hn::Load(d, direction[frame.axis[2]] + i);
    const auto forward = hn::Gt(hn::Mul(along, hn::Set(d, sign)), hn::Zero(d));
    // The axis as TriangleRay chooses it.
    const auto x_y = hn::Ge(size[0], size[1]);
    const auto x_z = hn::And(x_y, hn::Ge(size[0], size[2]));
    const auto y_z = hn::AndNot(x_y, hn::Ge(size[1], size[2]));
    const auto axis = frame.axis[2] == 0   ? x_z
                      : frame.axis[2] == 1 ? y_z
                                           : hn::Not(hn::Or(x_z, y_z));
    const auto fits = hn::And(hn::And(same, finite), hn::And(times, hn::And(forward, axis)));
    taken |= static_cast<uint64_t>(mask_bits(d, fits)) << i;
  }
  taken &= mask;

  // Rays that are not traced stand in for their neighbours and bound nothing.
  size_t last = first;
  if (taken != ~uint64_t{0} >> (64 - kSize)) {
    for (size_t i = 0; i < kSize; ++i) {
      if ((taken >> i & 1) != 0) {
        last = i;
        continue;
      }
      for (auto& axis : direction) axis[i] = axis[last];
      tmin[i] = INFINITY;
      limit[i] = -1;
    }
  }

  const auto forward = hn::Set(d, sign);
  auto least_x = hn::Set(d, INFINITY);
  auto least_y = least_x;
  auto most_x = hn::Neg(least_x);
  auto most_y = most_x;
  for (size_t i = 0; i < kSize; i += kStep) {
    const auto z = hn::Mul(hn::Load(d, direction[frame.axis[2]] + i), forward);
    const auto x = hn::Div(hn::Load(d, direction[frame.axis[0]] + i), z);
    const auto y = hn::Div(hn::Load(d, direction[frame.axis[1]] + i), z);
    hn::Store(x, d, slope[0] + i);
    hn::Store(y, d, slope[1] + i);
    hn::Store(z, d, depth_of_one + i);
    least_x = hn::Min(least_x, x);
    least_y = hn::Min(least_y, y);
    most_x = hn::Max(most_x, x);
    most_y = hn::Max(most_y, y);
    const auto t1 = hn::Load(d, limit + i);
    hn::Store(depth_before(d, hn::Load(d, tmin + i), z), d, near + i);
    hn::Store(hn::IfThenElse(hn::Lt(t1, hn::Zero(d)), t1, depth_beyond(d, t1, z)), d, far + i);
    hn::Store(hn::Set(dw, SOBB_MISS), dw, primitive + i);
  }
  const float least[2] = {hn::GetLane(hn::MinOfLanes(d, least_x)),
                          hn::GetLane(hn::MinOfLanes(d, least_y))};
  const float most[2] = {hn::GetLane(hn::MaxOfLanes(d, most_x)),
                         hn::GetLane(hn::MaxOfLanes(d, most_y))};
  for (int k = 0; k < 2; ++k) {
    centre[k] = (least[k] + most[k]) * 0.5F;
    spread[k] = std::max(most[k] - centre[k], centre[k] - least[k]) * (1 + 0x1p-20F);
  }

  const hn::CappedTag<double, 4> dd;
  const hn::Rebind<float, decltype(dd)> df;
  for (int k = 0; k < 2; ++k) {
    spread_runs<kSize>(slope[k], lane_slope[k][0]);
    const auto middle = hn::Set(dd, centre[k] * sign);
    for (size_t i = 0; i < kSize; i += hn::Lanes(dd)) {
      const auto z = hn::PromoteTo(dd, hn::Load(df, direction[frame.axis[2]] + i));
      const auto s = hn::Div(hn::PromoteTo(dd, hn::Load(df, direction[frame.axis[k]] + i)), z);
      hn::Store(s, dd, shear[k] + i);
      hn::Store(z, dd, direction_z + i);
      hn::Store(hn::DemoteTo(df, hn::Mul(hn::Sub(s, middle), hn::Set(dd, sign))), df, slope[k] + i);
    }
  }
  float nearest = INFINITY;
  for (int lane = 0; lane < kPacketLanes; ++lane) {
    float least_near = INFINITY;
    for (int i = 0; i < kRun; ++i) least_near = std::min(least_near, near[lane * kRun + i]);
    lane_near[lane] = least_near;
    nearest = std::min(nearest, least_near);
  }
  lane_near[kAllLanes] = nearest;
  update_lanes((1U << (kSize / kStep)) - 1);
  return taken;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
