// SPDX-License-Identifier: Apache-2.0
// The one ray-triangle test that decides. Every kernel and the oracle call this code, so that all
// return the same bits.
//
// After S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle Intersection" (2013), with the
// projection in double and rounded once to float. Then
//   - a vertex has one projection a ray, whichever triangle asks: no gap between neighbours;
//   - products of two floats are exact in double: an edge function has the sign, and but for one
//     rounding the value, of exact arithmetic on the projected vertices. So the barycentric
//     weights, and t, are those of a triangle whose vertices moved by at most half an ulp of their
//     distance from the ray, even for one seen edge-on: the hit point never leaves the volumes
//     that bound the triangle by more than their offsets allow (ray_table-inl.h).
#pragma once

#include <hwy/base.h>

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>

#include "sobb/sobb.h"

namespace sobb {

// Whether a ray is one that sobb.h promises a result for.
inline bool is_valid(const sobb_ray& ray) {
  float largest = 0;
  float nothing = 0;  // times what is not finite: not a number
  for (int k = 0; k < 3; ++k) {
    nothing += 0 * ray.origin[k] + 0 * ray.direction[k];
    largest = std::max(largest, std::fabs(ray.direction[k]));
  }
  return nothing == 0 && largest > 0 && ray.tmin >= 0 && ray.tmax == ray.tmax;
}

// A ray as the test wants it: axes permuted so that the direction is largest along z.
struct TriangleRay {
  int axis[3];       // which axes are x, y, z
  double origin[3];  // permuted
  double shear_x;    // d_x / d_z
  double shear_y;
  double direction_z;

  static constexpr int kNext[3] = {1, 2, 0};

  HWY_INLINE explicit TriangleRay(const sobb_ray& ray) {
    const float x = std::fabs(ray.direction[0]);
    const float y = std::fabs(ray.direction[1]);
    const float z = std::fabs(ray.direction[2]);
    // Looked up, since rays' directions are not to be predicted.
    static constexpr int kLargest[8] = {2, 2, 2, 0, 1, 2, 1, 0};
    axis[2] = kLargest[(x >= y ? 1 : 0) | (x >= z ? 2 : 0) | (y >= z ? 4 : 0)];
    axis[0] = kNext[axis[2]];
    axis[1] = kNext[axis[0]];
    for (int k = 0; k < 3; ++k) origin[k] = ray.origin[axis[k]];
    direction_z = ray.direction[axis[2]];
    shear_x = ray.direction[axis[0]] / direction_z;
    shear_y = ray.direction[axis[1]] / direction_z;
  }

  // Of what was found so already: the last axis, and the rest along the permuted ones.
  HWY_INLINE TriangleRay(int largest, const double (&from)[3], const double (&shear)[2], double dz)
      : axis{kNext[largest], kNext[kNext[largest]], largest},
        origin{from[0], from[1], from[2]},
        shear_x(shear[0]),
        shear_y(shear[1]),
        direction_z(dz) {}
};

struct TriangleHit {
  float t, u, v;
};

// Rounds to float. The empty statement keeps GCC 12 from dropping the conversion there and back
// when it vectorises straight-line code (-O3; seen as two lanes of a pair left unrounded).
inline double round_to_float(double value) {
  auto rounded = static_cast<float>(value);
  asm("" : "+x"(rounded));
  return rounded;
}

// A hit's t from its value in double: -0 becomes 0.
inline float round_hit_t(double t) { return static_cast<float>(t) + 0.0F; }

// Intersects the triangle of vertices (x[i], y[i], z[i]), given in the ray's permuted axes. The
// caller compares t with the ray's interval. Degenerate and exactly edge-on triangles are missed,
// as are those behind the origin.
inline bool intersect_triangle(const TriangleRay& ray, const float x[3], const float y[3],
                               const float z[3], TriangleHit& hit) {
  double px[3];
  double py[3];
  double pz[3];
  for (int i = 0; i < 3; ++i) {
    pz[i] = z[i] - ray.origin[2];
    px[i] = round_to_float((x[i] - ray.origin[0]) - ray.shear_x * pz[i]);
    py[i] = round_to_float((y[i] - ray.origin[1]) - ray.shear_y * pz[i]);
  }
  // Weights of the vertices, up to their sum: areas of the triangles that the ray and an edge make.
  const double w0 = px[2] * py[1] - py[2] * px[1];
  const double w1 = px[0] * py[2] - py[0] * px[2];
  const double w2 = px[1] * py[0] - py[1] * px[0];
  const bool inside = (w0 >= 0 && w1 >= 0 && w2 >= 0) || (w0 <= 0 && w1 <= 0 && w2 <= 0);
  const double sum = w0 + w1 + w2;
  if (!inside || sum == 0) return false;
  const double t = (w0 * pz[0] + w1 * pz[1] + w2 * pz[2]) / (sum * ray.direction_z);
  if (t < 0) return false;  // even if it would round to 0
  hit.t = round_hit_t(t);
  hit.u = static_cast<float>(w1 / sum);
  hit.v = static_cast<float>(w2 / sum);
  return true;
}

// The closest hit so far. Equal t goes to the lowest primitive; t is finite in every hit.
struct ClosestHit {
  float limit;  // t of the best so far, at first the ray's tmax
  float u = 0;
  float v = 0;
  uint32_t primitive = SOBB_MISS;

  explicit ClosestHit(const sobb_ray& ray) : limit(std::min(ray.tmax, FLT_MAX)) {}

  // Takes a hit if it is in the interval and before the best. Returns whether it was taken.
  bool offer(const TriangleHit& hit, float tmin, uint32_t index) {
    if (!takes(hit.t, tmin, index)) return false;
    *this = ClosestHit(hit, index);
    return true;
  }

  // The same of a hit as intersect_triangle() has it before it divides by the sum of the weights.
  bool offer(double t, double w1, double w2, double sum, float tmin, uint32_t index) {
    const float rounded = round_hit_t(t);
    if (!takes(rounded, tmin, index)) return false;
    *this =
        ClosestHit({rounded, static_cast<float>(w1 / sum), static_cast<float>(w2 / sum)}, index);
    return true;
  }

  sobb_hit result() const {
    // Selected by bits, not branched to: whether a ray hits is not to be predicted.
    const uint32_t miss = primitive == SOBB_MISS ? ~0U : 0;
    const uint32_t t =
        (std::bit_cast<uint32_t>(limit) & ~miss) | (std::bit_cast<uint32_t>(INFINITY) & miss);
    static_assert(SOBB_MISS == ~0U);
    return {std::bit_cast<float>(t), u, v, primitive, miss, SOBB_MISS};
  }

  // The result of a ray that hit nothing (SOBB_MISS) or is not valid (SOBB_INVALID).
  static sobb_hit missed(uint32_t why) { return {INFINITY, 0, 0, why, SOBB_MISS, SOBB_MISS}; }

 private:
  bool takes(float t, float tmin, uint32_t index) const {
    return t >= tmin && (t < limit || (t == limit && index < primitive));
  }

  ClosestHit(const TriangleHit& hit, uint32_t index)
      : limit(hit.t), u(hit.u), v(hit.v), primitive(index) {}
};

}  // namespace sobb
