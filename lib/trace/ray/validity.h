// SPDX-License-Identifier: Apache-2.0
// Which rays are valid: those that sobb.h promises a result for. ray_vectors-inl.h says the same
// for a vector of rays.
#pragma once

#include <algorithm>
#include <cmath>

#include "sobb/sobb.h"

namespace sobb {

inline bool is_valid(const sobb_ray& ray) {
  float largest = 0;
  float nothing = 0;  // not a number once an infinity or a NaN was multiplied by 0
  for (int k = 0; k < 3; ++k) {
    nothing += 0 * ray.origin[k] + 0 * ray.direction[k];
    largest = std::max(largest, std::fabs(ray.direction[k]));
  }
  return nothing == 0 && largest > 0 && ray.tmin >= 0 && ray.tmax == ray.tmax;
}

}  // namespace sobb
