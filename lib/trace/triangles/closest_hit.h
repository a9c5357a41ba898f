// SPDX-License-Identifier: Apache-2.0
// The closest hit that a ray has found so far, and the result that its caller gets.
#pragma once

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>

#include "sobb/sobb.h"
#include "trace/triangles/acceptance.h"
#include "trace/triangles/triangle_test.h"

namespace sobb {

// t is finite in every hit.
struct ClosestHit {
  float limit;  // t of the best so far, at first the ray's tmax
  float u = 0;
  float v = 0;
  uint32_t primitive = SOBB_MISS;

  explicit ClosestHit(const sobb_ray& ray) : limit(std::min(ray.tmax, FLT_MAX)) {}

  // Takes a hit if acceptance.h allows it. Returns whether it was taken.
  bool offer(const TriangleHit& hit, float tmin, uint32_t index) {
    if (!accepts({hit.t, index}, tmin, best())) return false;
    *this = ClosestHit(hit, index);
    return true;
  }

  // Takes a hit as intersect_triangle() has it before it divides by the sum of the weights: most
  // are not taken, and need no division.
  bool offer(double t, double w1, double w2, double sum, float tmin, uint32_t index) {
    const float rounded = round_hit_t(t);
    if (!accepts({rounded, index}, tmin, best())) return false;
    *this =
        ClosestHit({rounded, static_cast<float>(w1 / sum), static_cast<float>(w2 / sum)}, index);
    return true;
  }

  // Takes a hit that a conservative test is sure of, of a ray that looks for any. Its t, u and v
  // stay unknown, so that no condition may be left to ask.
  void take_sure_hit(uint32_t index) { primitive = index; }

  sobb_hit result() const {
    // Selected by bits, since a branch on whether a ray hits is mispredicted.
    const uint32_t miss = primitive == SOBB_MISS ? ~0U : 0;
    const uint32_t t =
        (std::bit_cast<uint32_t>(limit) & ~miss) | (std::bit_cast<uint32_t>(INFINITY) & miss);
    static_assert(SOBB_MISS == ~0U && kOnlyGeometry == 0);
    return {std::bit_cast<float>(t), u, v, primitive, miss, kNoInstance};
  }

  // The result of a ray that hit nothing (SOBB_MISS) or is not valid (SOBB_INVALID).
  static sobb_hit missed(uint32_t why) { return {INFINITY, 0, 0, why, SOBB_MISS, SOBB_MISS}; }

 private:
  Candidate best() const { return {limit, primitive}; }

  ClosestHit(const TriangleHit& hit, uint32_t index)
      : limit(hit.t), u(hit.u), v(hit.v), primitive(index) {}
};

// Stores a result as the query's caller wants it: a hit, or whether the ray is occluded.
inline void store(const ClosestHit& best, sobb_hit& hit) { hit = best.result(); }
inline void store(const ClosestHit& best, uint8_t& occluded) {
  occluded = best.primitive == SOBB_MISS ? SOBB_FREE : SOBB_OCCLUDED;
}
inline void store_invalid(sobb_hit& hit) { hit = ClosestHit::missed(SOBB_INVALID); }
inline void store_invalid(uint8_t& occluded) { occluded = SOBB_OCCLUDED_INVALID; }

}  // namespace sobb
