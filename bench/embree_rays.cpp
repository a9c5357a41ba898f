// SPDX-License-Identifier: Apache-2.0
// EmbreeRays copies rays into Embree's layouts and reads hits back.
#include "embree_rays.h"

#include <limits>

namespace sobb::bench {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

void load_ray(const sobb_ray& from, RTCRay& to) {
  to = {from.origin[0],
        from.origin[1],
        from.origin[2],
        from.tmin,
        from.direction[0],
        from.direction[1],
        from.direction[2],
        0,
        from.tmax,
        0xFFFFFFFFu,
        0,
        0};
}

void load_lane(const sobb_ray& from, RTCRay8& to, size_t lane) {
  to.org_x[lane] = from.origin[0];
  to.org_y[lane] = from.origin[1];
  to.org_z[lane] = from.origin[2];
  to.tnear[lane] = from.tmin;
  to.dir_x[lane] = from.direction[0];
  to.dir_y[lane] = from.direction[1];
  to.dir_z[lane] = from.direction[2];
  to.time[lane] = 0;
  to.tfar[lane] = from.tmax;
  to.mask[lane] = 0xFFFFFFFFu;
  to.id[lane] = 0;
  to.flags[lane] = 0;
}

sobb_hit hit_of(float t, float u, float v, unsigned geometry, unsigned primitive) {
  if (geometry == RTC_INVALID_GEOMETRY_ID) {
    return {kInfinity, 0, 0, SOBB_MISS, SOBB_MISS, SOBB_MISS};
  }
  return {t, u, v, primitive, geometry, SOBB_MISS};
}

// Embree marks an occluded ray by a negative tfar.
uint8_t occlusion_of(float tfar) { return tfar < 0 ? SOBB_OCCLUDED : SOBB_FREE; }

}  // namespace

void EmbreeRays::load(const RaySet& set, Call call) {
  const size_t count = set.rays.size();
  const size_t packets = (count + 7) / 8;
  for (size_t lane = 0; lane < 8; ++lane) {
    last_valid[lane] = 8 * (packets - 1) + lane < count ? -1 : 0;
  }
  if (call == Call::kPacket && set.any_hit()) {
    rays8.resize(packets);
    for (size_t i = 0; i < count; ++i) load_lane(set.rays[i], rays8[i / 8], i % 8);
  } else if (call == Call::kPacket) {
    rayhits8.resize(packets);
    for (size_t i = 0; i < count; ++i) {
      load_lane(set.rays[i], rayhits8[i / 8].ray, i % 8);
      rayhits8[i / 8].hit.geomID[i % 8] = RTC_INVALID_GEOMETRY_ID;
      rayhits8[i / 8].hit.instID[0][i % 8] = RTC_INVALID_GEOMETRY_ID;
    }
  } else if (set.any_hit()) {
    rays.resize(count);
    for (size_t i = 0; i < count; ++i) load_ray(set.rays[i], rays[i]);
  } else {
    rayhits.resize(count);
    for (size_t i = 0; i < count; ++i) {
      load_ray(set.rays[i], rayhits[i].ray);
      rayhits[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rayhits[i].hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    }
  }
}

void EmbreeRays::read(const RaySet& set, Call call, TraceOutput& output) const {
  output.resize(set);
  for (size_t i = 0; i < set.rays.size(); ++i) {
    if (set.any_hit()) {
      output.occluded[i] =
          occlusion_of(call == Call::kPacket ? rays8[i / 8].tfar[i % 8] : rays[i].tfar);
    } else if (call == Call::kPacket) {
      const RTCRayHit8& packet = rayhits8[i / 8];
      const size_t lane = i % 8;
      output.hits[i] = hit_of(packet.ray.tfar[lane], packet.hit.u[lane], packet.hit.v[lane],
                              packet.hit.geomID[lane], packet.hit.primID[lane]);
    } else {
      const RTCHit& hit = rayhits[i].hit;
      output.hits[i] = hit_of(rayhits[i].ray.tfar, hit.u, hit.v, hit.geomID, hit.primID);
    }
  }
}

}  // namespace sobb::bench
