// SPDX-License-Identifier: Apache-2.0
// A ray as the slab tests want it: relative to the scene's centre, and a direction that is very
// short or long scaled so that the largest component lies in [1, 2), t scaled with it.
//
// The room ray/ is a ray before it meets anything: whether it is valid (validity.h), scaled (this
// file), its coefficients for slabs (slab_coefficients-inl.h), its form for the triangle test
// (triangle_ray.h), and all of these for as many rays at once as a vector has lanes
// (ray_setup-inl.h). It knows trace.h and no other room.
#pragma once

#include <hwy/base.h>

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>

#include "sobb/sobb.h"
#include "trace/trace.h"

namespace sobb {

// What a float is rounded by at most, relatively: u in the comments on errors.
inline constexpr float kUnit = 0x1p-24F;

// A hit's t is rounded to float before it is scaled: where it is denormal, by up to this much.
inline constexpr float kSmallestFloat = 0x1p-149F;

// The scaled t up to which volumes matter to a ray whose best hit so far is at t. Near the largest
// floats it is infinite, which culls nothing.
inline float scale_limit(float t, float scale) { return (t + kSmallestFloat) * scale; }

struct ScaledRay {
  float origin[3];
  float direction[3];
  float tmin;   // in scaled units
  float scale;  // scaled t = t * scale, a power of two
  float reach;  // at least the distance from the origin to any vertex
  float error;  // e, how far slabs are widened for this ray (slab_coefficients-inl.h)

  // Directions whose largest component is between the inverse of it and it are left as they are.
  static constexpr float kLongest = 0x1p20F;
  static constexpr float kRelativeError = 16 * kUnit;
  static constexpr float kLeastError = 0x1p-100F;
  // The products of the slab test could overflow beyond this distance.
  static constexpr float kFurthest = 0x1p62F;

  HWY_INLINE ScaledRay(const TraceScene& scene, const sobb_ray& ray) : scale(1) {
    float largest = 0;
    float distance = 0;  // the sum of magnitudes is at least the length
    for (int k = 0; k < 3; ++k) {
      direction[k] = ray.direction[k];
      largest = std::max(largest, std::fabs(ray.direction[k]));
      origin[k] = ray.origin[k] - scene.centre[k];
      distance += std::fabs(origin[k]);
    }
    tmin = std::max(ray.tmin - kSmallestFloat, 0.0F);
    reach = distance + scene.radius;
    error = kRelativeError * (distance + reach) + kLeastError;
    if (!(largest >= 1 / kLongest && largest <= kLongest)) [[unlikely]]
      rescale(largest);
    if (!(distance <= kFurthest)) [[unlikely]]
      forgo_culling();
  }

 private:
  void rescale(float largest) {
    // A float is a normal double: its exponent is in the bits.
    const uint64_t exponent = std::bit_cast<uint64_t>(static_cast<double>(largest)) >> 52;
    const auto inverse = std::bit_cast<double>((2046 - exponent) << 52);
    for (float& d : direction) d = static_cast<float>(d * inverse);
    scale = static_cast<float>(std::bit_cast<double>(exponent << 52));
    tmin *= scale;
  }

  // An infinite error makes every slab interval infinite: the ray meets all triangles.
  void forgo_culling() {
    origin[0] = origin[1] = origin[2] = 0;
    reach = error = INFINITY;
  }
};

}  // namespace sobb
