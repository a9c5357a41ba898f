// SPDX-License-Identifier: Apache-2.0
// Vectors of doubles, with the same bits on every machine: only additions, products, quotients and
// square roots, which IEEE 754 defines to the last bit, and no libm.
#pragma once

#include <cmath>
#include <cstdint>

namespace sobb {

struct Vec3 {
  double x = 0;
  double y = 0;
  double z = 0;
};

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vec3 operator/(Vec3 a, double s) { return {a.x / s, a.y / s, a.z / s}; }
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline Vec3 normalized(Vec3 a) { return 1 / length(a) * a; }
inline Vec3 mix(Vec3 a, Vec3 b, double t) { return (1 - t) * a + t * b; }

inline Vec3 widen(const float* v) { return {v[0], v[1], v[2]}; }
inline void narrow(Vec3 v, float* out) {
  out[0] = float(v.x);
  out[1] = float(v.y);
  out[2] = float(v.z);
}

// A unit vector perpendicular to the unit vector `a`.
inline Vec3 perpendicular(Vec3 a) {
  return normalized(cross(a, a.x * a.x < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
}

struct SinCos {
  double sin = 0;
  double cos = 1;
};

// Sine and cosine of an angle in turns, to 1e-12: the nearest quarter turn is exact, and Taylor's
// series takes the rest.
inline SinCos sin_cos(double turns) {
  const double quarters = std::floor(4 * turns + 0.5);
  const double x = (4 * turns - quarters) * 1.5707963267948966;
  const double q = x * x;
  const double s =
      x * (1 - q / 6 * (1 - q / 20 * (1 - q / 42 * (1 - q / 72 * (1 - q / 110 * (1 - q / 156))))));
  const double c =
      1 - q / 2 * (1 - q / 12 * (1 - q / 30 * (1 - q / 56 * (1 - q / 90 * (1 - q / 132)))));
  switch (int64_t(quarters) & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

}  // namespace sobb
