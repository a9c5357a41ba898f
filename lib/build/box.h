// SPDX-License-Identifier: Apache-2.0
// Axis-aligned boxes, as the topology is built of.
#pragma once

#include <algorithm>

#include "build/mesh.h"

namespace sobb {

struct Box {
  float lower[3];
  float upper[3];

  // Half the surface area, in double: coordinates up to 2^60 would overflow.
  double half_area() const {
    const double x = static_cast<double>(upper[0]) - lower[0];
    const double y = static_cast<double>(upper[1]) - lower[1];
    const double z = static_cast<double>(upper[2]) - lower[2];
    return x * y + y * z + z * x;
  }

  bool operator==(const Box& other) const {
    return std::equal(lower, lower + 3, other.lower) && std::equal(upper, upper + 3, other.upper);
  }
};

// The corners of a triangle as arrays of three axes.
struct Corners {
  float at[3][3];  // [corner][axis]

  Corners(const Mesh& mesh, uint64_t triangle) {
    for (int i = 0; i < 3; ++i) {
      const Point p = mesh.corner(triangle, i);
      at[i][0] = p.x;
      at[i][1] = p.y;
      at[i][2] = p.z;
    }
  }

  Box box() const {
    Box box;
    for (int k = 0; k < 3; ++k) {
      box.lower[k] = std::min({at[0][k], at[1][k], at[2][k]});
      box.upper[k] = std::max({at[0][k], at[1][k], at[2][k]});
    }
    return box;
  }
};

}  // namespace sobb
