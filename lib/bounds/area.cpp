// SPDX-License-Identifier: Apache-2.0
#include "bounds/area.h"

#include <cmath>

namespace sobb {
namespace {

Vector as_vector(const Direction& n) { return {n.x, n.y, n.z}; }

}  // namespace

double determinant(const Direction& a, const Direction& b, const Direction& c) {
  return dot(as_vector(a), cross(as_vector(b), as_vector(c)));
}

double slab_area(const Direction normal[3], const double width[3]) {
  return 2 * (width[0] * width[1] + width[1] * width[2] + width[2] * width[0]) /
         std::fabs(determinant(normal[0], normal[1], normal[2]));
}

void slab_edges(const Direction normal[3], const double width[3], Vector edge[3]) {
  const double det = determinant(normal[0], normal[1], normal[2]);
  for (int i = 0; i < 3; ++i) {
    edge[i] = cross(as_vector(normal[(i + 1) % 3]), as_vector(normal[(i + 2) % 3]));
    for (double& component : edge[i]) component *= width[i] / det;
  }
}

double edge_area(const Vector edge[3]) {
  return 2 * (length(cross(edge[0], edge[1])) + length(cross(edge[1], edge[2])) +
              length(cross(edge[2], edge[0])));
}

}  // namespace sobb
