// SPDX-License-Identifier: Apache-2.0
#include "bounds/fitted_directions.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bounds/direction_table.h"

namespace sobb {
namespace {

// Sine of the angle by which two peaks may miss a right angle, and are one frame all the same.
constexpr double kPerpendicular = 0.01;
// A frame nearer to the axes than this is theirs: the normals of small triangles are no better.
constexpr double kAxesDistance = 1e-5;

Vector normalized(const Vector& v) {
  const double norm = length(v);
  return {v[0] / norm, v[1] / norm, v[2] / norm};
}

// The part of v perpendicular to a unit vector.
Vector reject(const Vector& v, const Vector& from) {
  const double along = dot(v, from);
  return normalized({v[0] - along * from[0], v[1] - along * from[1], v[2] - along * from[2]});
}

Vector second_axis(const Vector& first, std::span<const DirectionPeak> normals,
                   std::span<const DirectionPeak> edges) {
  for (const auto& peaks : {normals, edges}) {
    for (const DirectionPeak& peak : peaks) {
      if (std::fabs(dot(peak.direction, first)) < kPerpendicular) {
        return reject(peak.direction, first);
      }
    }
  }
  // The axis that is most nearly perpendicular.
  const auto flattest = std::min_element(
      first.begin(), first.end(), [](double a, double b) { return std::fabs(a) < std::fabs(b); });
  Vector axis{0, 0, 0};
  axis[static_cast<size_t>(flattest - first.begin())] = 1;
  return reject(axis, first);
}

// Which vector stands for which axis, and with which sign: such that the cosines sum up highest.
SceneFrame nearest_to_axes(const Vector (&vectors)[3]) {
  int order[3] = {0, 1, 2};
  int best[3] = {0, 1, 2};
  double most = 0;
  do {
    double sum = 0;
    for (size_t k = 0; k < 3; ++k) sum += std::fabs(vectors[order[k]][k]);
    if (sum > most) {
      most = sum;
      std::copy(order, order + 3, best);
    }
  } while (std::next_permutation(order, order + 3));
  SceneFrame frame;
  for (size_t k = 0; k < 3; ++k) {
    frame.axis[k] = vectors[best[k]];
    if (frame.axis[k][k] < 0) {
      for (double& component : frame.axis[k]) component = -component;
    }
  }
  return frame;
}

double distance(const SceneFrame& a, const SceneFrame& b) {
  double most = 0;
  for (size_t k = 0; k < 3; ++k) {
    for (size_t i = 0; i < 3; ++i) {
      most = std::max(most, std::fabs(a.axis[k][i] - b.axis[k][i]));
    }
  }
  return most;
}

Direction to_direction(const Vector& v) {
  const Vector unit = normalized(v);
  return {static_cast<float>(unit[0]), static_cast<float>(unit[1]), static_cast<float>(unit[2])};
}

double cosine(const Direction& a, const Direction& b) { return std::fabs(dot(a, b)); }

}  // namespace

SceneFrame scene_frame(std::span<const DirectionPeak> normals,
                       std::span<const DirectionPeak> edges) {
  const SceneFrame axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  if (normals.empty()) return axes;
  const Vector& first = normals[0].direction;
  const Vector second = second_axis(first, normals, edges);
  const SceneFrame frame = nearest_to_axes({first, second, cross(first, second)});
  return distance(frame, axes) < kAxesDistance ? axes : frame;
}

std::vector<Direction> fit_directions(uint32_t k, const SceneFrame& frame,
                                      std::span<const DirectionPeak> normals) {
  std::vector<Direction> directions;
  for (const Direction& n : default_directions(k)) {
    Vector turned;
    for (size_t i = 0; i < 3; ++i) {
      turned[i] = n.x * frame.axis[0][i] + n.y * frame.axis[1][i] + n.z * frame.axis[2][i];
    }
    directions.push_back(to_direction(turned));
  }
  size_t first = 3;  // of those that may be replaced
  for (const DirectionPeak& peak : normals) {
    const Direction wanted = to_direction(peak.direction);
    const auto near_wanted = [&](const Direction& a, const Direction& b) {
      return cosine(a, wanted) < cosine(b, wanted);
    };
    const auto kept = directions.begin() + static_cast<ptrdiff_t>(first);
    const Direction& taken = *std::max_element(directions.begin(), kept, near_wanted);
    if (cosine(taken, wanted) > 0.9999 || kept == directions.end()) continue;
    std::iter_swap(kept, std::max_element(kept, directions.end(), near_wanted));
    *kept = wanted;
    ++first;
  }
  return directions;
}

}  // namespace sobb
