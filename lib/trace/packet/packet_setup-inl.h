// SPDX-License-Identifier: Apache-2.0
// Makes a packet of the rays of an array that fit in it together.
#if defined(SOBB_TRACE_PACKET_PACKET_SETUP_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_PACKET_PACKET_SETUP_INL_H
#undef SOBB_TRACE_PACKET_PACKET_SETUP_INL_H
#else
#define SOBB_TRACE_PACKET_PACKET_SETUP_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/simd/mask_bits-inl.h"
#include "trace/packet/packet_depth-inl.h"
#include "trace/packet/packet_rays-inl.h"
#include "trace/ray/ray_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Turns values by ray into values by place in the beam, in any order, then beam: evens go before
// odds until a beam has one value.
template <int kCount>
HWY_INLINE void spread_beams(const float* from, float* to) {
  const BeamFloats d;
  constexpr int kStep = hn::MaxLanes(BeamFloats());
  constexpr int kHalf = kCount / 2;
  alignas(64) float parts[kCount];
  float* out = kHalf == kBeams ? to : parts;
  for (int i = 0; i < kHalf; i += kStep) {
    const auto a = hn::Load(d, from + 2 * i);
    const auto b = hn::Load(d, from + 2 * i + kStep);
    hn::Store(hn::ConcatEven(d, b, a), d, out + i);
    hn::Store(hn::ConcatOdd(d, b, a), d, out + kHalf + i);
  }
  if constexpr (kHalf > kBeams) {
    spread_beams<kHalf>(parts, to);
    spread_beams<kHalf>(parts + kHalf, to + kHalf);
  }
}

// Returns where rays may meet: where the first begins, or if the last does not, where it ends.
template <bool kOwnOrigins>
HWY_INLINE PacketFocus find_focus(const sobb_ray& first, const sobb_ray& last) {
  PacketFocus focus = {{first.origin[0], first.origin[1], first.origin[2]}, false};
  if (!kOwnOrigins || std::equal(first.origin, first.origin + 3, last.origin)) return focus;
  for (int k = 0; k < 3; ++k) {
    focus.at[k] =
        static_cast<float>(first.origin[k] + double{first.tmax} * double{first.direction[k]});
  }
  focus.backward = true;
  return focus;
}

template <int kSize, bool kOwnOrigins>
class PacketSetup {
 public:
  using Rays = PacketRays<kSize, kOwnOrigins>;

  PacketSetup(const TraceScene& scene, Rays& packet) : scene_(scene), packet_(packet) {}

  // Fills the packet with the rays of the mask that are valid and share its focus, axis and sign.
  // Returns which they are.
  HWY_INLINE uint64_t take(const sobb_ray* rays, uint64_t mask) {
    uint64_t taken = 0;
    for (size_t i = 0; i < kSize; i += kStep) taken |= load(rays, i) << i;
    taken &= mask;
    if (taken != ~uint64_t{0} >> (64 - kSize)) stand_in(taken, std::countr_zero(mask));
    set_slopes();
    set_test_rays();
    if (kOwnOrigins && packet_.focus.backward) set_backward();
    set_beams();
    return taken;
  }

 private:
  static constexpr size_t kStep = kRayLanes;
  using V = hn::Vec<RayFloats>;
  using M = hn::Mask<RayFloats>;
  using Doubles = hn::CappedTag<double, 4>;
  using DoublesAsFloats = hn::Rebind<float, Doubles>;

  // Loads as many rays as a vector has lanes. Returns which of them fit. (Of the parts of validity
  // goes_along() covers a zero direction, begins_there() and ends_there() the origin.)
  HWY_INLINE uint64_t load(const sobb_ray* rays, size_t i) {
    const RayFloats d;
    const RayVectors some(rays + i);
    V size[3];
    auto fits = some.has_valid_interval();
    for (int k = 0; k < 3; ++k) {
      if (!kOwnOrigins || !packet_.focus.backward) {
        fits = hn::And(fits, begins_there(some.origin[k], k));
      }
      if (kOwnOrigins) hn::Store(some.origin[k], d, origin_[k] + i);
      hn::Store(some.direction[k], d, direction_[k] + i);
      size[k] = hn::Abs(some.direction[k]);
    }
    fits = hn::And(fits, are_finite(size));
    hn::Store(some.tmin, d, packet_.tmin + i);
    hn::Store(hn::Min(some.tmax, hn::Set(d, FLT_MAX)), d, packet_.limit + i);
    fits = hn::And(fits, goes_along(size, i));
    if (kOwnOrigins && packet_.focus.backward) fits = hn::And(fits, ends_there(i));
    return mask_bits(d, fits);
  }

  HWY_INLINE M begins_there(V origin, int k) const {
    const RayFloats d;
    const RayWords dw;
    const auto expected = hn::Set(dw, std::bit_cast<uint32_t>(packet_.focus.at[k]));
    return hn::RebindMask(d, hn::Eq(hn::BitCast(dw, origin), expected));
  }

  // Tells whether the largest axis, as TriangleRay chooses it, is the packet's, with its sign.
  HWY_INLINE M goes_along(const V (&size)[3], size_t i) const {
    const RayFloats d;
    const int axis = packet_.projection.axis[2];
    const auto along = hn::Mul(hn::Load(d, direction_[axis] + i), hn::Set(d, packet_.sign));
    const auto forward =
        packet_.focus.backward ? hn::Lt(along, hn::Zero(d)) : hn::Gt(along, hn::Zero(d));
    return hn::And(forward, LargestAxis(size).is(axis));
  }

  // Tells whether rays pierce the focus' plane near the focus and end there at the latest.
  HWY_INLINE M ends_there(size_t i) {
    const RayFloats d;
    const int* axis = packet_.projection.axis;
    const auto from_focus = [&](int k) HWY_ATTR {
      return hn::Sub(hn::Load(d, origin_[axis[k]] + i), hn::Set(d, packet_.permuted_focus[k]));
    };
    const auto depth = hn::Mul(from_focus(2), hn::Set(d, packet_.sign));
    const auto length = hn::Abs(hn::Load(d, direction_[axis[2]] + i));
    const auto most = hn::Mul(length, hn::Set(d, packet_.tolerance()));
    const auto limit = hn::Load(d, packet_.limit + i);
    auto near = hn::And(hn::Ge(limit, hn::Zero(d)), hn::Le(hn::Sub(hn::Mul(limit, length), depth),
                                                           hn::Set(d, packet_.tolerance())));
    for (int k = 0; k < 2; ++k) {
      const auto off =
          hn::MulAdd(hn::Load(d, direction_[axis[k]] + i), depth, hn::Mul(from_focus(k), length));
      near = hn::And(near, hn::Le(hn::Abs(off), most));
    }
    auto distance = hn::Zero(d);
    for (int k = 0; k < 3; ++k) {
      const auto o = hn::Sub(hn::Load(d, origin_[k] + i), hn::Set(d, scene_.centre[k]));
      distance = hn::Add(distance, hn::Abs(o));
    }
    const auto of_taken = hn::IfThenElseZero(near, distance);
    furthest_ = std::max(furthest_, hn::GetLane(hn::MaxOfLanes(d, of_taken)));
    return near;
  }

  // Replaces rays that are not traced by copies of their neighbours that bound nothing.
  HWY_NOINLINE void stand_in(uint64_t taken, int first) {
    auto last = static_cast<size_t>(first);
    for (size_t i = 0; i < kSize; ++i) {
      if ((taken >> i & 1) != 0) {
        last = i;
        continue;
      }
      for (int k = 0; k < 3; ++k) {
        direction_[k][i] = direction_[k][last];
        if (kOwnOrigins) origin_[k][i] = origin_[k][last];
      }
      packet_.tmin[i] = INFINITY;
      packet_.limit[i] = -1;
    }
  }

  HWY_INLINE void set_slopes() {
    const RayFloats d;
    const RayWords dw;
    const int* axis = packet_.projection.axis;
    V least[2] = {hn::Set(d, INFINITY), hn::Set(d, INFINITY)};
    V most[2] = {hn::Set(d, -INFINITY), hn::Set(d, -INFINITY)};
    for (size_t i = 0; i < kSize; i += kStep) {
      const auto z = hn::Mul(hn::Load(d, direction_[axis[2]] + i), hn::Set(d, packet_.sign));
      for (int k = 0; k < 2; ++k) {
        const auto slope = hn::Div(hn::Load(d, direction_[axis[k]] + i), z);
        hn::Store(slope, d, packet_.slope[k] + i);
        least[k] = hn::Min(least[k], slope);
        most[k] = hn::Max(most[k], slope);
      }
      const auto t1 = hn::Load(d, packet_.limit + i);
      const auto t0 = hn::Load(d, packet_.tmin + i);
      hn::Store(z, d, packet_.depth_of_one + i);
      hn::Store(depth_before(d, t0, z), d, packet_.near + i);
      hn::Store(hn::IfThenElse(hn::Lt(t1, hn::Zero(d)), t1, depth_beyond(d, t1, z)), d,
                packet_.far + i);
      hn::Store(hn::Set(dw, SOBB_MISS), dw, packet_.primitive + i);
    }
    for (int k = 0; k < 2; ++k) {
      const float low = hn::GetLane(hn::MinOfLanes(d, least[k]));
      const float high = hn::GetLane(hn::MaxOfLanes(d, most[k]));
      const float centre = (low + high) * 0.5F;
      packet_.centre[k] = centre;
      packet_.spread[k] = std::max(high - centre, centre - low) * (1 + 0x1p-20F);
      spread_beams<kSize>(packet_.slope[k], packet_.beam_slope[k][0]);
    }
  }

  // Sets what the deciding test reads, and slopes from the middle.
  HWY_INLINE void set_test_rays() {
    const Doubles d;
    const DoublesAsFloats df;
    const int* axis = packet_.projection.axis;
    const auto sign = hn::Set(d, packet_.sign);
    for (int k = 0; k < 2; ++k) {
      const auto middle = hn::Set(d, packet_.centre[k] * packet_.sign);
      for (size_t i = 0; i < kSize; i += hn::MaxLanes(d)) {
        const auto z = hn::PromoteTo(d, hn::Load(df, direction_[axis[2]] + i));
        const auto s = hn::Div(hn::PromoteTo(d, hn::Load(df, direction_[axis[k]] + i)), z);
        hn::Store(s, d, packet_.shear[k] + i);
        hn::Store(z, d, packet_.direction_z + i);
        hn::Store(hn::DemoteTo(df, hn::Mul(hn::Sub(s, middle), sign)), df, packet_.slope[k] + i);
      }
    }
    for (int k = 0; kOwnOrigins && k < 3; ++k) {
      for (size_t i = 0; i < kSize; i += hn::MaxLanes(d)) {
        const auto o = hn::PromoteTo(d, hn::Load(df, origin_[axis[k]] + i));
        hn::Store(o, d, packet_.origin[k] + i);
      }
    }
  }

  // Sets the depths of rays that end at the focus, and how far they are from it. It works in
  // double, whose rounding, here and in the deciding test, 2^-48 of the largest depth covers.
  HWY_INLINE void set_backward() {
    const Doubles d;
    const DoublesAsFloats df;
    const auto zero = hn::Zero(d);
    auto furthest = zero;
    auto off = zero;
    for (size_t i = 0; i < kSize; i += hn::MaxLanes(d)) {
      const auto from_focus = [&](int k) HWY_ATTR {
        return hn::Sub(hn::Load(d, packet_.origin[k] + i),
                       hn::Set(d, double{packet_.permuted_focus[k]}));
      };
      const auto z = from_focus(2);
      for (int k = 0; k < 2; ++k) {
        const auto pierces = hn::NegMulAdd(hn::Load(d, packet_.shear[k] + i), z, from_focus(k));
        off = hn::Max(off, hn::Abs(pierces));
      }
      const auto depth = hn::Mul(z, hn::Set(d, double{packet_.sign}));
      const auto size = hn::Abs(hn::Load(d, packet_.direction_z + i));
      const auto t1 = hn::PromoteTo(d, hn::Load(df, packet_.limit + i));
      const auto t0 = hn::PromoteTo(d, hn::Load(df, packet_.tmin + i));
      const auto smallest = hn::Set(d, double{kSmallestFloat});  // as depth_before() has it
      const auto begin = hn::Mul(hn::Max(hn::Sub(t0, smallest), zero), size);
      const auto end = hn::Mul(hn::Add(t1, smallest), size);
      const auto last = hn::Mul(end, hn::Set(d, 1 + 0x1p-23));  // a hit's t is rounded
      off = hn::Max(off, hn::Sub(last, depth));
      furthest = hn::Max(furthest, hn::Abs(depth));
      const auto slack = hn::MulAdd(hn::Abs(depth), hn::Set(d, 0x1p-21), hn::Set(d, 0x1p-100));
      const auto near = hn::NegMulAdd(end, hn::Set(d, 1 + 0x1p-21), hn::Sub(depth, slack));
      const auto far = hn::NegMulAdd(begin, hn::Set(d, 1 - 0x1p-21), hn::Add(depth, slack));
      const auto active = hn::Ge(t1, zero);
      hn::Store(hn::DemoteTo(
                    df, hn::IfThenElse(active, hn::Max(near, zero), hn::Set(d, double{INFINITY}))),
                df, packet_.near + i);
      hn::Store(hn::DemoteTo(df, hn::IfThenElse(active, hn::Max(far, zero), hn::Set(d, -1.0))), df,
                packet_.far + i);
    }
    const double all =
        hn::GetLane(hn::MaxOfLanes(d, off)) + 0x1p-48 * hn::GetLane(hn::MaxOfLanes(d, furthest));
    packet_.widen(scene_, static_cast<float>(all) * (1 + 0x1p-20F), furthest_);
  }

  HWY_INLINE void set_beams() {
    constexpr int kBeamRays = Rays::kBeamRays;
    float nearest = INFINITY;
    for (int beam = 0; beam < kBeams; ++beam) {
      float least = INFINITY;
      for (int i = 0; i < kBeamRays; ++i)
        least = std::min(least, packet_.near[beam * kBeamRays + i]);
      packet_.beam_near[beam] = least;
      nearest = std::min(nearest, least);
    }
    packet_.beam_near[kWholePacket] = nearest;
    packet_.update_beams((1U << (kSize / kStep)) - 1);
  }

  const TraceScene& scene_;
  Rays& packet_;
  float furthest_ = 0;  // of the origins, from the centre
  alignas(64) float direction_[3][kSize];
  alignas(64) float origin_[3][kOwnOrigins ? kSize : 1];
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
