// SPDX-License-Identifier: Apache-2.0
// Boxes along the axes of the topology's frame.
//
// The room `builder/boxes` holds what binary hierarchies are made of: the frame, boxes along it,
// triangles cut to boxes (clip.h), references to triangles (references.h), and the nodes
// (binary_nodes.h). It knows the mesh and direction tables; how a hierarchy is chosen is the
// business of `builder/sah` and `builder/topology`.
#pragma once

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "builder/boxes/frame.h"
#include "builder/mesh.h"

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

  void grow(const Box& other) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], other.lower[k]);
      upper[k] = std::max(upper[k], other.upper[k]);
    }
  }

  // Shrinks the box to what both have in common; inside out where that is nothing.
  void clip(const Box& other) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::max(lower[k], other.lower[k]);
      upper[k] = std::min(upper[k], other.upper[k]);
    }
  }

  bool operator==(const Box& other) const {
    return std::equal(lower, lower + 3, other.lower) && std::equal(upper, upper + 3, other.upper);
  }
};

// The nearest floats below and above a number; the number itself where it is a float.
inline float float_below(double value) {
  const auto rounded = static_cast<float>(value);
  return rounded <= value ? rounded : std::nextafter(rounded, -FLT_MAX);
}
inline float float_above(double value) {
  const auto rounded = static_cast<float>(value);
  return rounded >= value ? rounded : std::nextafter(rounded, FLT_MAX);
}

// A triangle's corners in double, in the frame and in the mesh's coordinates.
struct Corners {
  double at[3][3];     // [corner][axis], in the topology's frame
  double point[3][3];  // [corner][axis], in the mesh's coordinates
  bool turned;         // whether the two differ

  Corners(const Mesh& mesh, uint64_t triangle, const Frame& frame = Frame())
      : turned(frame.is_turned()) {
    for (int i = 0; i < 3; ++i) {
      const Point p = mesh.corner(triangle, i);
      point[i][0] = p.x;
      point[i][1] = p.y;
      point[i][2] = p.z;
      frame.turn(p, at[i]);
    }
  }

  // The box in the frame, rounded outward.
  Box box() const {
    Box box;
    for (int k = 0; k < 3; ++k) {
      box.lower[k] = float_below(std::min({at[0][k], at[1][k], at[2][k]}));
      box.upper[k] = float_above(std::max({at[0][k], at[1][k], at[2][k]}));
    }
    return box;
  }
};

// A triangle's box in a frame, rounded outward where the frame is turned and exact where it is not.
inline Box box_of(const Mesh& mesh, uint64_t triangle, const Frame& frame) {
  if (frame.is_turned()) return Corners(mesh, triangle, frame).box();
  const Point a = mesh.corner(triangle, 0);
  const Point b = mesh.corner(triangle, 1);
  const Point c = mesh.corner(triangle, 2);
  return {{std::min(std::min(a.x, b.x), c.x), std::min(std::min(a.y, b.y), c.y),
           std::min(std::min(a.z, b.z), c.z)},
          {std::max(std::max(a.x, b.x), c.x), std::max(std::max(a.y, b.y), c.y),
           std::max(std::max(a.z, b.z), c.z)}};
}

}  // namespace sobb
