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
//     that bound the triangle by more than their offsets allow (slab_coefficients-inl.h).
//
// The room triangles/ is a ray against the triangles of a leaf: this test, its form in lanes
// (watertight_lanes-inl.h), four triangles at once (watertight_ray-inl.h), lists of candidates
// (candidates-inl.h), and the seam at which a candidate becomes a hit (acceptance.h). It knows
// ray/.
#pragma once

#include <hwy/base.h>

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>

#include "trace/ray/triangle_ray.h"

namespace sobb {

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

}  // namespace sobb
