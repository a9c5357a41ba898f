// SPDX-License-Identifier: Apache-2.0
// Arithmetic of the built-in scenes, with the same bits on every machine: additions, products,
// quotients and square roots of doubles, which IEEE 754 defines to the last bit, and no libm.
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
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline Vec3 normalized(Vec3 a) { return 1 / length(a) * a; }
inline Vec3 mix(Vec3 a, Vec3 b, double t) { return (1 - t) * a + t * b; }

// A unit vector perpendicular to a unit vector.
inline Vec3 perpendicular(Vec3 a) {
  return normalized(cross(a, a.x * a.x < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
}

struct SinCos {
  double sin = 0;
  double cos = 1;
};

// Sine and cosine of a whole number of turns: the nearest quarter turn exactly, Taylor's series for
// the rest, to 1e-12.
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

// Draw twice in one expression only within braces, which C++ evaluates in order.
//
// SplitMix64 (Steele, Lea, Flood, Fast Splittable Pseudorandom Number Generators, 2014).
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}

  uint64_t bits() { return mix_bits(state_ += 0x9E3779B97F4A7C15); }
  double uniform() { return double(bits() >> 11) * 0x1p-53; }  // in [0, 1)
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  uint64_t below(uint64_t n) { return uint64_t(uniform() * double(n)); }

  // A unit vector, all directions alike: by rejection, since that needs a square root only.
  Vec3 direction() {
    for (;;) {
      const Vec3 v{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      const double square = dot(v, v);
      if (square > 0.01 && square < 1) return normalized(v);
    }
  }

  // A hash of 64 bits, the generator's output function.
  static uint64_t mix_bits(uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return z ^ (z >> 31);
  }

 private:
  uint64_t state_;
};

}  // namespace sobb
