// SPDX-License-Identifier: Apache-2.0
#include "bounds/directions/fitted_directions.h"

#include <algorithm>
#include <cmath>

#include "bounds/directions/direction_table.h"

namespace sobb {
namespace {

// The cosine up to which two peaks count as perpendicular.
constexpr double kPerpendicular = 0.01;
// Two frames are one if all components differ by less than this.
constexpr double kSameFrame = 1e-3;
// A frame is the axes if all components differ by less than this, which only rounding explains.
constexpr double kAxesDistance = 1e-5;

Vector scaled(const Vector& v, double factor) {
  return {v[0] * factor, v[1] * factor, v[2] * factor};
}

// The part of v perpendicular to a unit vector, made a unit vector.
Vector reject(const Vector& v, const Vector& from) {
  const double along = dot(v, from);
  const Vector part = {v[0] - along * from[0], v[1] - along * from[1], v[2] - along * from[2]};
  return scaled(part, 1 / length(part));
}

double distance(const OrthogonalFrame& a, const OrthogonalFrame& b) {
  double most = 0;
  for (size_t k = 0; k < 3; ++k) {
    for (size_t i = 0; i < 3; ++i) {
      most = std::max(most, std::fabs(a.axis[k][i] - b.axis[k][i]));
    }
  }
  return most;
}

// Orders and signs two vectors and their cross product so that the cosines with the axes have the
// greatest sum.
OrthogonalFrame nearest_to_axes(const Vector& first, const Vector& second) {
  const Vector vectors[3] = {first, second, cross(first, second)};
  size_t order[3] = {0, 1, 2};
  size_t best[3] = {0, 1, 2};
  double most = 0;
  do {
    double sum = 0;
    for (size_t k = 0; k < 3; ++k) sum += std::fabs(vectors[order[k]][k]);
    if (sum > most) {
      most = sum;
      std::copy(order, order + 3, best);
    }
  } while (std::next_permutation(order, order + 3));
  OrthogonalFrame frame;
  for (size_t k = 0; k < 3; ++k) {
    const Vector& v = vectors[best[k]];
    frame.axis[k] = scaled(v, v[k] < 0 ? -1 : 1);
  }
  return frame;
}

}  // namespace

std::pmr::vector<OrthogonalFrame> candidate_frames(std::span<const DirectionPeak> normals,
                                                   std::span<const DirectionPeak> edges,
                                                   std::span<const OrthogonalFrame> principal,
                                                   std::pmr::memory_resource& memory) {
  const OrthogonalFrame axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::pmr::vector<OrthogonalFrame> frames({axes}, &memory);
  const auto add = [&](const Vector& first, const Vector& second, size_t room) {
    const OrthogonalFrame frame = nearest_to_axes(first, reject(second, first));
    const auto same = [&](const OrthogonalFrame& other) {
      return distance(frame, other) < (&other == frames.data() ? kAxesDistance : kSameFrame);
    };
    if (frames.size() < room && std::none_of(frames.begin(), frames.end(), same)) {
      frames.push_back(frame);
    }
  };
  std::pmr::vector<Vector> peaks(&memory);
  for (const auto& list : {normals, edges}) {
    for (const DirectionPeak& peak : list) peaks.push_back(peak.direction);
  }
  for (size_t second = 1; second < peaks.size(); ++second) {
    for (size_t first = 0; first < second; ++first) {
      if (std::fabs(dot(peaks[first], peaks[second])) < kPerpendicular) {
        add(peaks[first], peaks[second], kMostFrames - principal.size());
      }
    }
  }
  for (const OrthogonalFrame& frame : principal) add(frame.axis[0], frame.axis[1], kMostFrames);
  return frames;
}

std::pmr::vector<Direction> turned_directions(uint32_t k, const OrthogonalFrame& frame,
                                              std::pmr::memory_resource& memory) {
  std::pmr::vector<Direction> directions(&memory);
  for (const Direction& n : default_directions(k)) {
    Vector turned;
    for (size_t i = 0; i < 3; ++i) {
      turned[i] = n.x * frame.axis[0][i] + n.y * frame.axis[1][i] + n.z * frame.axis[2][i];
    }
    directions.push_back({static_cast<float>(turned[0]), static_cast<float>(turned[1]),
                          static_cast<float>(turned[2])});
  }
  return directions;
}

}  // namespace sobb
