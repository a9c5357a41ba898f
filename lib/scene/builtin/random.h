// SPDX-License-Identifier: Apache-2.0
// The random numbers of the built-in scenes: the same bits on every machine.
#pragma once

#include <cstdint>

#include "scene/model/vec3.h"

namespace sobb {

// SplitMix64 (Steele, Lea, Flood, Fast Splittable Pseudorandom Number Generators, 2014).
//
// An expression may draw twice only within braces, which C++ evaluates in order.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}

  uint64_t bits() { return mix_bits(state_ += 0x9E3779B97F4A7C15); }
  double uniform() { return double(bits() >> 11) * 0x1p-53; }  // in [0, 1)
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  uint64_t below(uint64_t n) { return uint64_t(uniform() * double(n)); }

  // A unit vector, every direction as likely: drawn by rejection, which needs a square root only.
  Vec3 direction() {
    for (;;) {
      const Vec3 v{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      const double square = dot(v, v);
      if (square > 0.01 && square < 1) return normalized(v);
    }
  }

  // The generator's output function, which is a hash of 64 bits.
  static uint64_t mix_bits(uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return z ^ (z >> 31);
  }

 private:
  uint64_t state_;
};

}  // namespace sobb
