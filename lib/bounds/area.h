// SPDX-License-Identifier: Apache-2.0
// The surface area of a skewed oriented bounding box, in both its forms.
#pragma once

#include <array>
#include <cmath>

#include "bounds/basis.h"

namespace sobb {

using Vector = std::array<double, 3>;

inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline double length(const Vector& a) { return std::sqrt(dot(a, a)); }

inline double dot(const Direction& a, const Direction& b) {
  return static_cast<double>(a.x) * b.x + static_cast<double>(a.y) * b.y +
         static_cast<double>(a.z) * b.z;
}

// det[a b c], the volume that three normals span.
double determinant(const Direction& a, const Direction& b, const Direction& c);

// The area by the slab form, 2 (d0 d1 + d1 d2 + d2 d0) / |det[n0 n1 n2]|, where d are the widths of
// the slabs and the normals have length 1 (EG25, equation 3).
double slab_area(const Direction normal[3], const double width[3]);

// Computes the edges of the parallelepiped of three slabs: e_i = d_i (n_j x n_l) / det crosses slab
// i and is parallel to the other two.
void slab_edges(const Direction normal[3], const double width[3], Vector edge[3]);

// The area by the edge form, 2 (|e0 x e1| + |e1 x e2| + |e2 x e0|) (EG25, equation 2).
double edge_area(const Vector edge[3]);

}  // namespace sobb
