// SPDX-License-Identifier: Apache-2.0
// See polygon.h.
#include "scene/model/polygon.h"

#include <array>
#include <cmath>
#include <mapbox/earcut.hpp>
#include <tuple>
#include <utility>

namespace sobb {
namespace {

using Point = std::array<double, 2>;

// What a fan may cover too much, as a share of the polygon's area.
constexpr double kTolerance = 0x1p-20;

// Twice the polygon's area, along the normal of its best-fit plane (Newell's formula).
Vec3 area_vector(std::span<const Vec3> corners) {
  Vec3 sum;
  for (size_t i = 2; i < corners.size(); ++i) {
    sum = sum + cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  }
  return sum;
}

bool is_zero(Vec3 v) { return v.x == 0 && v.y == 0 && v.z == 0; }

// The polygon in its plane, counterclockwise: the corners are projected along the normal onto the
// plane of two axes, which keeps coordinates along the axes exact.
std::vector<Point> project(std::span<const Vec3> corners) {
  const Vec3 normal = area_vector(corners);
  const double size[3] = {std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)};
  std::vector<Point> points;
  points.reserve(corners.size());
  for (const Vec3 corner : corners) {
    const Vec3 d = corner - corners[0];
    Point p{};
    if (size[0] > size[1] && size[0] > size[2]) {
      p = {d.y - d.x * (normal.y / normal.x), d.z - d.x * (normal.z / normal.x)};
      if (normal.x < 0) std::swap(p[0], p[1]);
    } else if (size[1] > size[2]) {
      p = {d.z - d.y * (normal.z / normal.y), d.x - d.y * (normal.x / normal.y)};
      if (normal.y < 0) std::swap(p[0], p[1]);
    } else {
      const double slope_x = size[2] > 0 ? normal.x / normal.z : 0;
      const double slope_y = size[2] > 0 ? normal.y / normal.z : 0;
      p = {d.x - d.z * slope_x, d.y - d.z * slope_y};
      if (normal.z < 0) std::swap(p[0], p[1]);
    }
    points.push_back(p);
  }
  return points;
}

}  // namespace

bool fan_covers(std::span<const Vec3> corners) {
  const Vec3 normal = area_vector(corners);
  const double allowed = -kTolerance * dot(normal, normal);
  double turned_over = 0;  // areas of triangles that face the other way
  Vec3 first;              // the direction that the others lie to the left of, within half a turn
  for (size_t i = 2; i < corners.size(); ++i) {
    const Vec3 before = corners[i - 1] - corners[0];
    const Vec3 d = corners[i] - corners[0];
    turned_over += std::fmin(0, dot(cross(before, d), normal));
    if (is_zero(first)) first = before;
    // Four corners, none turned over, cannot go round more than once.
    if (corners.size() > 4 && dot(cross(first, d), normal) < allowed) return false;
  }
  return turned_over >= allowed;
}

std::vector<uint32_t> clip_ears(std::span<const Vec3> corners, std::function<size_t()> allowance) {
  const std::array<std::vector<Point>, 1> rings = {project(corners)};
  mapbox::detail::Earcut<uint32_t> earcut;
  earcut.allowance = std::move(allowance);
  earcut(rings);
  return std::move(earcut.indices);
}

}  // namespace sobb
