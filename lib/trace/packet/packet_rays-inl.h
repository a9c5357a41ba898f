// SPDX-License-Identifier: Apache-2.0
// The rays of a packet: lines through one point, the focus, their directions largest along one axis
// with one sign, so that all share a projection.
//
// Depth is the distance from the focus along that axis; with it as the parameter, instead of t, a
// ray is focus + depth (slope_x, slope_y, +-1) in the axes permuted as triangle_ray.h does, and
// interval arithmetic on neighbouring rays bounds the beam that they span, not much more. A packet
// has eight beams, of kBeamRays neighbours each.
//
// The focus is where the rays begin, or where they end: shadow rays of a point light, whose depth
// runs from the light towards their origins. In any-hit queries no order is lost by that. Origins
// and directions were rounded, so that such rays meet only nearly. `deviation` is what none
// exceeds: along either projected axis the distance from the focus to where a ray pierces the
// focus' plane, and the depth by which a hit of the ray may lie behind that plane. So a point of a
// ray has one on its model within deviation (2^(1/2) + 3^(1/2)), the second term for a point behind
// the plane, which depth 0 stands for: the slabs are widened by 4 deviations (packet_table-inl.h).
// The deciding test knows the rays as they are.
#if defined(SOBB_TRACE_PACKET_PACKET_RAYS_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_PACKET_PACKET_RAYS_INL_H
#undef SOBB_TRACE_PACKET_PACKET_RAYS_INL_H
#else
#define SOBB_TRACE_PACKET_PACKET_RAYS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>

#include "trace/ray/ray_vectors-inl.h"
#include "trace/ray/scaled_ray.h"
#include "trace/ray/triangle_ray.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

inline constexpr int kBeams = 8;
// The index, behind the beams, of what bounds the whole packet.
inline constexpr int kWholePacket = kBeams;
// Beams over the lanes.
using BeamFloats = hn::CappedTag<float, kBeams>;

// PacketFocus is where the rays of a packet meet.
struct PacketFocus {
  float at[3];
  bool backward;  // they end there
};

// kOwnOrigins: the deciding test takes each ray's origin, not the focus.
template <int kSize, bool kOwnOrigins>
struct PacketRays {
  static constexpr int kBeamRays = kSize / kBeams;

  // What all share.
  TriangleRay projection;  // of the first ray: axes and origin
  PacketFocus focus;
  ScaledRay centred;  // the focus from the centre, and the error of slabs
  float sign;         // of depth along projection.axis[2]
  float permuted_focus[3];
  float deviation = 0;  // of rays from lines through the focus
  float centre[2];      // slopes in the middle of the packet
  float spread[2];      // no slope is further from there

  // One element per ray.
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

  // One element per beam, then one for the whole packet.
  alignas(64) float beam_near[kBeams + 1];
  alignas(64) float beam_far[kBeams + 1];
  // Slopes by place in the beam, in any order, then beam.
  alignas(64) float beam_slope[2][kBeamRays][kBeams];

  PacketRays(const TraceScene& scene, const sobb_ray& first, const PacketFocus& where)
      : projection(first),
        focus(where),
        centred(scene, moved(first, focus.at)),
        sign((projection.direction_z < 0) != focus.backward ? -1.0F : 1.0F) {
    for (int k = 0; k < 3; ++k) permuted_focus[k] = focus.at[projection.axis[k]];
  }

  // How far from the focus a ray may end, or pierce its plane: some rounding errors of the origin
  // and the direction, as the caller has them, and of the end that the caller meant.
  float tolerance() const {
    const float size =
        std::abs(permuted_focus[0]) + std::abs(permuted_focus[1]) + std::abs(permuted_focus[2]);
    return 8 * centred.error + 0x1p-21F * size;
  }

  // Widens the slabs for rays that are `off` the focus, with origins as far from the centre as
  // `furthest`.
  void widen(const TraceScene& scene, float off, float furthest) {
    deviation = off;
    const float more = std::max(furthest - (centred.reach - scene.radius), 0.0F);
    centred.error += 4 * off + 2 * ScaledRay::kRelativeError * more;
  }

  // Sets how far any ray of a beam still matters, after limits in some vectors of rays changed.
  HWY_INLINE void update_beams(uint32_t vectors) {
    const RayFloats d;
    constexpr int kStep = kRayLanes;
    for (; vectors != 0; vectors &= vectors - 1) {
      const int first = std::countr_zero(vectors) * kStep;
      if constexpr (kBeamRays == kStep) {
        beam_far[first / kBeamRays] = hn::GetLane(hn::MaxOfLanes(d, hn::Load(d, far + first)));
      } else {
        const int begin = first / kBeamRays;
        const int end = std::max(begin + 1, (first + kStep) / kBeamRays);
        for (int beam = begin; beam < end; ++beam) {
          beam_far[beam] = *std::max_element(far + beam * kBeamRays, far + (beam + 1) * kBeamRays);
        }
      }
    }
    beam_far[kWholePacket] = *std::max_element(beam_far, beam_far + kBeams);
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
