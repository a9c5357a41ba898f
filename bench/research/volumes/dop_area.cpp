// SPDX-License-Identifier: Apache-2.0
#include "volumes/dop_area.h"

#include <algorithm>
#include <cmath>

#include "bounds/area.h"

namespace sobb::study {
namespace {

double product(const Direction& n, const Vector& v) { return n.x * v[0] + n.y * v[1] + n.z * v[2]; }

// A convex polygon in coordinates of its plane. Every clip adds a vertex at most.
class Polygon {
 public:
  explicit Polygon(double half_side)
      : vertex_{{-half_side, -half_side},
                {half_side, -half_side},
                {half_side, half_side},
                {-half_side, half_side}} {}

  // Keeps the points with a x + b y <= c.
  void clip(double a, double b, double c) {
    double value[kMost];
    bool cuts = false;
    for (int i = 0; i < count_; ++i) {
      value[i] = a * vertex_[i][0] + b * vertex_[i][1] - c;
      cuts |= value[i] > 0;
    }
    if (!cuts) return;
    double kept[kMost][2];
    int kept_count = 0;
    for (int i = 0; i < count_; ++i) {
      const int next = i + 1 == count_ ? 0 : i + 1;
      if (value[i] <= 0) std::copy(vertex_[i], vertex_[i] + 2, kept[kept_count++]);
      if ((value[i] <= 0) == (value[next] <= 0)) continue;
      const double s = value[i] / (value[i] - value[next]);
      for (int k = 0; k < 2; ++k) {
        kept[kept_count][k] = vertex_[i][k] + s * (vertex_[next][k] - vertex_[i][k]);
      }
      ++kept_count;
    }
    count_ = kept_count;
    std::copy(&kept[0][0], &kept[0][0] + size_t{2} * static_cast<size_t>(count_), &vertex_[0][0]);
  }

  double area() const {
    double twice = 0;
    for (int i = 0; i < count_; ++i) {
      const int next = i + 1 == count_ ? 0 : i + 1;
      twice += vertex_[i][0] * vertex_[next][1] - vertex_[next][0] * vertex_[i][1];
    }
    return twice / 2;
  }

 private:
  static constexpr int kMost = 40;

  double vertex_[kMost][2];
  int count_ = 4;
};

// Two directions in the plane of normal n.
void span_plane(const Direction& n, Vector& u, Vector& v) {
  const Vector normal = {n.x, n.y, n.z};
  const Vector helper = std::fabs(n.x) < 0.6 ? Vector{1, 0, 0} : Vector{0, 1, 0};
  u = cross(normal, helper);
  const double norm = length(u);
  for (double& component : u) component /= norm;
  v = cross(normal, u);
}

}  // namespace

double dop_area(std::span<const Direction> normals, const float (*slab)[2]) {
  Vector centre;
  double reach = 0;  // from the box's centre to its corner, and so to any point of the volume
  for (int k = 0; k < 3; ++k) {
    centre[k] = (static_cast<double>(slab[k][0]) + slab[k][1]) / 2;
    reach += std::fabs(static_cast<double>(slab[k][1]) - slab[k][0]);
  }
  double sum = 0;
  for (size_t face = 0; face < normals.size(); ++face) {
    const Direction& n = normals[face];
    Vector u;
    Vector v;
    span_plane(n, u, v);
    for (int side = 0; side < 2; ++side) {
      const double height = slab[face][side] - product(n, centre);
      const Vector origin = {centre[0] + height * n.x, centre[1] + height * n.y,
                             centre[2] + height * n.z};
      Polygon polygon(reach);
      for (size_t k = 0; k < normals.size(); ++k) {
        if (k == face) continue;
        const double a = product(normals[k], u);
        const double b = product(normals[k], v);
        const double at = product(normals[k], origin);
        polygon.clip(a, b, slab[k][1] - at);
        polygon.clip(-a, -b, at - slab[k][0]);
      }
      sum += polygon.area();
    }
  }
  return sum;
}

}  // namespace sobb::study
