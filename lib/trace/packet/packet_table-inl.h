// SPDX-License-Identifier: Apache-2.0
// A packet's side of the slab tests: for a direction of the table, what bounds the depths at which
// any ray of a beam may be within a slab. An entry is made when its direction is first met.
//
// With s = n . d over the rays of a beam in [s0, s1], 0 < s0, and q = p - n . o widened as
// slab_coefficients-inl.h does, depths within the slab lie from q_lower / s1 to q_upper / s0: where
// the first is negative it bounds nothing, since depths are not; where the second is, the slab is
// behind all rays. For s1 < 0 likewise with the planes exchanged. Where s has both signs in the
// packet the slab bounds nothing.
#if defined(SOBB_TRACE_PACKET_PACKET_TABLE_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_PACKET_PACKET_TABLE_INL_H
#undef SOBB_TRACE_PACKET_PACKET_TABLE_INL_H
#else
#define SOBB_TRACE_PACKET_PACKET_TABLE_INL_H
#endif

#include <hwy/highway.h>

#include "format/layout.h"
#include "trace/packet/packet_rays-inl.h"
#include "trace/ray/slab_coefficients-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

struct PacketTable {
  // One element per beam, then one for the whole packet: depth = plane * scale + offset.
  struct Entry {
    alignas(64) float near_scale[kBeams + 1];
    alignas(64) float near_offset[kBeams + 1];
    alignas(64) float far_scale[kBeams + 1];
    alignas(64) float far_offset[kBeams + 1];
  };
  Entry entry[kMaxDirections];
  uint8_t falls[kMaxDirections];  // 1: rays go down along the direction, the upper plane is nearer
  uint32_t made = 0;              // bit k: entry k

  // Makes the entries of a basis that are not there yet.
  template <class Rays>
  HWY_INLINE void require(const TraceScene& scene, const Rays& rays, uint32_t basis) {
    const uint32_t needed = 1U << basis_direction(basis, 0) | 1U << basis_direction(basis, 1) |
                            1U << basis_direction(basis, 2);
    for (uint32_t left = needed & ~made; left != 0; left &= left - 1) {
      make(scene, rays, static_cast<uint32_t>(std::countr_zero(left)));
    }
    made |= needed;
  }

 private:
  template <class Rays>
  HWY_NOINLINE void make(const TraceScene& scene, const Rays& rays, uint32_t k) {
    const DirectionTable& table = scene.directions;
    const float n[3] = {table.x[k], table.y[k], table.z[k]};
    const float* o = rays.centred.origin;
    const float no = n[0] * o[0] + n[1] * o[1] + n[2] * o[2];
    const BeamFloats d;
    const auto nx = hn::Set(d, n[rays.projection.axis[0]]);
    const auto ny = hn::Set(d, n[rays.projection.axis[1]]);
    const auto nz = hn::Set(d, n[rays.projection.axis[2]] * rays.sign);
    alignas(64) float least[kBeams];
    alignas(64) float most[kBeams];
    auto all_least = hn::Set(d, INFINITY);
    auto all_most = hn::Set(d, -INFINITY);
    for (size_t beam = 0; beam < kBeams; beam += hn::Lanes(d)) {
      auto low = hn::Set(d, INFINITY);
      auto high = hn::Set(d, -INFINITY);
      for (int i = 0; i < Rays::kBeamRays; ++i) {
        const auto s = hn::MulAdd(nx, hn::Load(d, rays.beam_slope[0][i] + beam),
                                  hn::MulAdd(ny, hn::Load(d, rays.beam_slope[1][i] + beam), nz));
        low = hn::Min(low, s);
        high = hn::Max(high, s);
      }
      hn::Store(low, d, least + beam);
      hn::Store(high, d, most + beam);
      all_least = hn::Min(all_least, low);
      all_most = hn::Max(all_most, high);
    }
    const float s0 = hn::GetLane(hn::MinOfLanes(d, all_least));
    const float s1 = hn::GetLane(hn::MaxOfLanes(d, all_most));
    const bool rises = s0 >= kSmallestCosine;
    const bool falling = s1 <= -kSmallestCosine;
    falls[k] = falling;
    Entry& e = entry[k];
    if (!rises && !falling) {
      for (int beam = 0; beam <= kWholePacket; ++beam) {
        e.near_scale[beam] = e.far_scale[beam] = e.near_offset[beam] = 0;
        e.far_offset[beam] = INFINITY;
      }
      return;
    }
    const float error = rays.centred.error;
    const auto fill = [&](auto dv, size_t at, auto low, auto high) HWY_ATTR {
      const auto one = hn::Set(dv, 1.0F);
      const auto near = hn::Div(one, rises ? high : low);
      const auto far = hn::Div(one, rises ? low : high);
      const auto offset = hn::Set(dv, no);
      const auto slack = hn::Set(dv, error);
      hn::Store(near, dv, e.near_scale + at);
      hn::Store(far, dv, e.far_scale + at);
      hn::Store(hn::Neg(hn::Add(hn::Mul(offset, near), hn::Mul(slack, hn::Abs(near)))), dv,
                e.near_offset + at);
      hn::Store(hn::Sub(hn::Mul(slack, hn::Abs(far)), hn::Mul(offset, far)), dv, e.far_offset + at);
    };
    for (size_t beam = 0; beam < kBeams; beam += hn::Lanes(d)) {
      fill(d, beam, hn::Load(d, least + beam), hn::Load(d, most + beam));
    }
    const hn::CappedTag<float, 1> one;
    fill(one, kWholePacket, hn::Set(one, s0), hn::Set(one, s1));
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
