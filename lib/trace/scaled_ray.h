// SPDX-License-Identifier: Apache-2.0
// A ray as the slab tests want it: relative to the scene's centre, its direction scaled so that the
// largest component lies in [1, 2), t scaled with it.
#pragma once

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>

#include "sobb/sobb.h"
#include "trace/tracer.h"

namespace sobb {

// A hit's t is rounded to float before it is scaled: where it is denormal, by up to this much.
inline constexpr double kSmallestFloat = 0x1p-149;

// The scaled t up to which volumes matter to a ray whose best hit so far is at t. Near the largest
// floats it is infinite, which culls nothing.
inline float scale_limit(float t, double scale) {
  return static_cast<float>((t + kSmallestFloat) * scale);
}

struct ScaledRay {
  float origin[3];
  float direction[3];
  float tmin;    // in scaled units
  double scale;  // scaled t = t * scale, a power of two
  float reach;   // at least the distance from the origin to any vertex
  float error;   // e, how far slabs are widened for this ray (ray_table-inl.h)

  ScaledRay(const TraceScene& scene, const sobb_ray& ray) {
    double largest = 0;
    double square = 0;
    for (int k = 0; k < 3; ++k) {
      largest = std::fmax(largest, std::fabs(static_cast<double>(ray.direction[k])));
      origin[k] = ray.origin[k] - scene.centre[k];
      square += static_cast<double>(origin[k]) * origin[k];
    }
    // A float is a normal double: its exponent is in the bits.
    const uint64_t exponent = std::bit_cast<uint64_t>(largest) >> 52;
    scale = std::bit_cast<double>(exponent << 52);
    const auto inverse = std::bit_cast<double>((2046 - exponent) << 52);
    for (int k = 0; k < 3; ++k) {
      direction[k] = static_cast<float>(ray.direction[k] * inverse);
    }
    tmin = static_cast<float>(std::fmax(ray.tmin - kSmallestFloat, 0.0) * scale);
    const auto distance = static_cast<float>(std::sqrt(square));
    reach = distance + scene.radius;
    error = 16 * 0x1p-24F * (distance + reach) + 0x1p-100F;
    if (!(distance <= kFurthest)) forgo_culling();
  }

 private:
  // Beyond this the products of the slab test could overflow.
  static constexpr float kFurthest = 0x1p62F;

  // An infinite error makes every slab interval infinite: the ray meets all triangles.
  void forgo_culling() {
    origin[0] = origin[1] = origin[2] = 0;
    reach = error = INFINITY;
  }
};

}  // namespace sobb
