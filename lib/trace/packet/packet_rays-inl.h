// SPDX-License-Identifier: Apache-2.0
// The rays of a packet: lines through one point, the focus, their directions largest along one axis
// with one sign, so that all share a projection. Included once for each Highway target.
//
// Depth is the distance from the focus along that axis; with it as the parameter, instead of t, a
// ray is focus + depth (slope_x, slope_y, +-1) in the axes permuted as triangle_test.h does, and
// interval arithmetic on neighbouring rays bounds the beam that they span, not much more.
// Neighbours share a lane: a packet has eight, of `kRun` rays each.
//
// The focus is where the rays begin, or where they end: shadow rays of a point light, whose depth
// runs from the light towards their origins. Where any hit will do, no order is lost by that.
// Origins and directions were rounded, so such rays meet but nearly. `deviation` is what none
// exceeds: along either projected axis the distance from the focus to where a ray pierces the
// focus' plane, and the depth by which a hit of the ray may lie behind that plane. So a point of a
// ray has one on its model within deviation (2^(1/2) + 3^(1/2)), the second term for a point behind
// the plane, which depth 0 stands for: by 4 deviations the slabs are widened (packet_table-inl.h).
// The deciding test knows the rays as they are.
#if defined(SOBB_TRACE_PACKET_PACKET_RAYS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_PACKET_PACKET_RAYS_INL_H
#undef SOBB_TRACE_PACKET_PACKET_RAYS_INL_H
#else
#define SOBB_TRACE_PACKET_PACKET_RAYS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>

#include "base/simd/mask_bits-inl.h"
#include "trace/ray/ray_vectors-inl.h"
#include "trace/ray/scaled_ray.h"
#include "trace/triangles/triangle_test.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kPacketLanes = 8;
constexpr int kAllLanes = kPacketLanes;  // index of what is of the whole packet, behind the lanes

// Where the rays of a packet meet.
struct PacketFocus {
  float at[3];
  bool backward;  // they end there
};

// kOwnOrigins: the deciding test takes each ray's origin, not the focus.
template <int kSize, bool kOwnOrigins>
struct PacketRays {
  static constexpr int kRun = kSize / kPacketLanes;

  // What all share.
  TriangleRay frame;    // of the first ray: axes and origin
  PacketFocus meeting;  // the focus, and whether depth runs against the directions
  ScaledRay centred;    // the focus from the centre, and the error of slabs
  float sign;           // of depth along frame.axis[2]
  float focus[3];       // permuted
  float deviation = 0;  // of rays from lines through the focus
  float centre[2];      // slopes in the middle of the packet
  float spread[2];      // no slope is further from there

  // By ray.
  alignas(64) double origin[3][kOwnOrigins ? kSize : 1];  // permuted
  alignas(64) double shear[2][kSize];                     // as TriangleRay has them
  alignas(64) double direction_z[kSize];
  alignas(64) float slope[2][kSize];      // from `centre`
  alignas(64) float depth_of_one[kSize];  // depth that t = 1 adds
  alignas(64) float tmin[kSize];
  alignas(64) float limit[kSize];  // t of the best hit so far; of an inactive ray negative
  alignas(64) float near[kSize];   // the least depth that matters, or less
  alignas(64) float far[kSize];    // the greatest, or more; of an inactive ray negative
  alignas(64) float u[kSize];
  alignas(64) float v[kSize];
  alignas(64) uint32_t primitive[kSize];

  // By lane, and then of all.
  alignas(64) float lane_near[kPacketLanes + 8];
  alignas(64) float lane_far[kPacketLanes + 8];
  // Slopes by place in the run, then lane.
  alignas(64) float lane_slope[2][kRun][kPacketLanes];

  PacketRays(const TraceScene& scene, const sobb_ray& first, const PacketFocus& where)
      : frame(first),
        meeting(where),
        centred(scene, moved(first, meeting.at)),
        sign((frame.direction_z < 0) != meeting.backward ? -1.0F : 1.0F) {
    for (int k = 0; k < 3; ++k) focus[k] = meeting.at[frame.axis[k]];
  }

  // How far from the focus a ray may end, or pierce its plane: some rounding errors. Of the origin
  // and the direction that is, as the caller has them, and of the end that he meant.
  float tolerance() const {
    const float size = std::abs(focus[0]) + std::abs(focus[1]) + std::abs(focus[2]);
    return 8 * centred.error + 0x1p-21F * size;
  }

  // For rays that are `off` the focus, with origins as far from the centre as `furthest`.
  void widen(const TraceScene& scene, float off, float furthest) {
    deviation = off;
    const float more = std::max(furthest - (centred.reach - scene.radius), 0.0F);
    centred.error += 4 * off + 2 * ScaledRay::kRelativeError * more;
  }

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

 private:
  static sobb_ray moved(sobb_ray ray, const float (&to)[3]) {
    std::copy_n(to, 3, ray.origin);
    return ray;
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
