// SPDX-License-Identifier: Apache-2.0
// A ray as the deciding triangle test wants it (triangles/triangle_test.h): axes permuted so that
// the direction is largest along z, and the shear that turns the direction into that axis.
#pragma once

#include <hwy/base.h>

#include <cmath>

#include "sobb/sobb.h"

namespace sobb {

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
    // Looked up, since a branch on rays' directions is mispredicted.
    static constexpr int kLargest[8] = {2, 2, 2, 0, 1, 2, 1, 0};
    axis[2] = kLargest[(x >= y ? 1 : 0) | (x >= z ? 2 : 0) | (y >= z ? 4 : 0)];
    axis[0] = kNext[axis[2]];
    axis[1] = kNext[axis[0]];
    for (int k = 0; k < 3; ++k) origin[k] = ray.origin[axis[k]];
    direction_z = ray.direction[axis[2]];
    shear_x = ray.direction[axis[0]] / direction_z;
    shear_y = ray.direction[axis[1]] / direction_z;
  }

  // Takes parts that a vector of rays has made: `largest` is the last axis, the rest is permuted.
  HWY_INLINE TriangleRay(int largest, const double (&from)[3], const double (&shear)[2], double dz)
      : axis{kNext[largest], kNext[kNext[largest]], largest},
        origin{from[0], from[1], from[2]},
        shear_x(shear[0]),
        shear_y(shear[1]),
        direction_z(dz) {}
};

}  // namespace sobb
