// SPDX-License-Identifier: Apache-2.0
#include "volumes/ditetrahedron.h"

#include <algorithm>
#include <cmath>

namespace sobb::study {
namespace {

constexpr int kPoints = 2 * ExtremalPoints::kNormals;

using Point3 = RelativePoint;

Point3 operator-(const Point3& a, const Point3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

float product(const Point3& a, const Point3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Point3 cross_product(const Point3& a, const Point3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Scales to length 1. Returns false for a vector too short to have a direction.
bool normalise(Point3& v) {
  const float length = std::sqrt(product(v, v));
  if (!(length > 0x1p-60F)) return false;
  v = {v.x / length, v.y / length, v.z / length};
  return true;
}

class Ditetrahedron {
 public:
  explicit Ditetrahedron(const ExtremalPoints& extremal) : points_(&extremal.point[0][0]) {
    for (int i = 0; i < kPadded; ++i) {
      const Point3& p = points_[i < kPoints ? i : 0];
      x_[i] = p.x;
      y_[i] = p.y;
      z_[i] = p.z;
    }
    basis_[0] = {1, 0, 0};
    basis_[1] = {0, 1, 0};
    basis_[2] = {0, 0, 1};
    area_ = half_area(basis_);
    search(extremal);
  }

  const Point3* basis() const { return basis_; }

 private:
  // The base triangle consists of the two extremal points furthest apart and the point furthest
  // from their line. The points furthest above and below it make two tetrahedra.
  void search(const ExtremalPoints& extremal) {
    const Point3* far[2] = {};
    float furthest = -1;
    for (const auto& pair : extremal.point) {
      const Point3 apart = pair[1] - pair[0];
      if (product(apart, apart) <= furthest) continue;
      furthest = product(apart, apart);
      far[0] = &pair[0];
      far[1] = &pair[1];
    }
    Point3 edge = *far[1] - *far[0];
    if (!normalise(edge)) return;
    const Point3* apex = far[0];
    float off_line = 0;
    for (int i = 0; i < kPoints; ++i) {
      const Point3 from = points_[i] - *far[0];
      const Point3 across = cross_product(from, edge);
      if (product(across, across) <= off_line) continue;
      off_line = product(across, across);
      apex = &points_[i];
    }
    if (off_line <= 0x1p-40F * furthest) return try_along(edge);
    try_triangle(*far[0], *far[1], *apex);

    const Point3 normal = cross_product(edge, *apex - *far[0]);
    const Point3* top[2] = {far[0], far[0]};
    float height[2] = {0, 0};
    for (int i = 0; i < kPoints; ++i) {
      const float above = product(points_[i] - *far[0], normal);
      if (above > height[1]) {
        height[1] = above;
        top[1] = &points_[i];
      } else if (above < height[0]) {
        height[0] = above;
        top[0] = &points_[i];
      }
    }
    for (int side = 0; side < 2; ++side) {
      if (height[side] == 0) continue;
      try_triangle(*far[0], *far[1], *top[side]);
      try_triangle(*far[1], *apex, *top[side]);
      try_triangle(*apex, *far[0], *top[side]);
    }
  }

  // The points lie on a line, so any two directions across it serve.
  void try_along(const Point3& edge) {
    const Point3 helper = std::fabs(edge.x) < 0.6F ? Point3{1, 0, 0} : Point3{0, 1, 0};
    Point3 normal = cross_product(edge, helper);
    if (normalise(normal)) try_basis(edge, normal);
  }

  void try_triangle(const Point3& a, const Point3& b, const Point3& c) {
    Point3 edge[3] = {b - a, c - b, a - c};
    Point3 normal = cross_product(edge[0], edge[1]);
    if (!normalise(normal)) return;
    for (Point3& along : edge) {
      if (normalise(along)) try_basis(along, normal);
    }
  }

  void try_basis(const Point3& along, const Point3& normal) {
    const Point3 candidate[3] = {along, normal, cross_product(normal, along)};
    const float area = half_area(candidate);
    if (!(area < area_)) return;
    area_ = area;
    std::copy(candidate, candidate + 3, basis_);
  }

  // Four points at a time: the compiler makes vectors of the inner loops.
  float half_area(const Point3 basis[3]) const {
    float width[3];
    for (int axis = 0; axis < 3; ++axis) {
      float lower[kLanes];
      float upper[kLanes];
      std::fill(lower, lower + kLanes, INFINITY);
      std::fill(upper, upper + kLanes, -INFINITY);
      for (int first = 0; first < kPadded; first += kLanes) {
        for (int lane = 0; lane < kLanes; ++lane) {
          const int i = first + lane;
          const float along = x_[i] * basis[axis].x + y_[i] * basis[axis].y + z_[i] * basis[axis].z;
          lower[lane] = along < lower[lane] ? along : lower[lane];
          upper[lane] = along > upper[lane] ? along : upper[lane];
        }
      }
      width[axis] =
          *std::max_element(upper, upper + kLanes) - *std::min_element(lower, lower + kLanes);
    }
    return width[0] * width[1] + width[1] * width[2] + width[2] * width[0];
  }

  static constexpr int kLanes = 4;
  static constexpr int kPadded = 16;  // the last two repeat the first

  const Point3* points_;
  float x_[kPadded];
  float y_[kPadded];
  float z_[kPadded];
  Point3 basis_[3];
  float area_;
};

}  // namespace

void ditetrahedron_basis(const ExtremalPoints& extremal, Direction basis[3]) {
  const Ditetrahedron best(extremal);
  for (int i = 0; i < 3; ++i) {
    basis[i] = {best.basis()[i].x, best.basis()[i].y, best.basis()[i].z};
  }
}

}  // namespace sobb::study
