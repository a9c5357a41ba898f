// SPDX-License-Identifier: Apache-2.0
#include "study/binary/fibre_split.h"

#include <cmath>

#include "builder/boxes/box.h"

namespace sobb::study {
namespace {

constexpr int kRounds = 4;

Vector normalized(Vector v) {
  const double norm = length(v);
  for (double& x : v) x = norm > 0 ? x / norm : 0;
  return v;
}

Vector longest_edge(const Corners& triangle) {
  Vector longest{};
  for (int i = 0; i < 3; ++i) {
    Vector edge;
    for (size_t k = 0; k < 3; ++k) {
      edge[k] = static_cast<double>(triangle.at[(i + 1) % 3][k]) - triangle.at[i][k];
    }
    if (dot(edge, edge) > dot(longest, longest)) longest = edge;
  }
  return longest;
}

Vector furthest_from(const Vector& line, std::span<const Reference> references,
                     const std::vector<Vector>& tangents) {
  Vector furthest = line;
  double least = 2;
  for (const Reference& reference : references) {
    const Vector& tangent = tangents[reference.primitive];
    const double cosine = std::fabs(dot(line, tangent));
    if (dot(tangent, tangent) > 0 && cosine < least) {
      least = cosine;
      furthest = tangent;
    }
  }
  return furthest;
}

}  // namespace

std::vector<Vector> fibre_tangents(const Mesh& mesh) {
  std::vector<Vector> tangents(mesh.triangle_count());
  for (uint64_t i = 0; i < tangents.size(); ++i) {
    tangents[i] = normalized(longest_edge(Corners(mesh, i)));
  }
  return tangents;
}

bool FibreSplit::is_second(const Vector& tangent) const {
  return std::fabs(dot(mean[1], tangent)) > std::fabs(dot(mean[0], tangent));
}

std::optional<FibreSplit> split_fibres(std::span<const Reference> references,
                                       const std::vector<Vector>& tangents) {
  FibreSplit split;
  split.mean[0] = furthest_from(tangents[references[0].primitive], references, tangents);
  split.mean[1] = furthest_from(split.mean[0], references, tangents);
  for (int round = 0; round < kRounds; ++round) {
    Vector sum[2] = {};
    for (const Reference& reference : references) {
      const Vector& tangent = tangents[reference.primitive];
      const bool second = split.is_second(tangent);
      const double sign = dot(split.mean[second], tangent) < 0 ? -1 : 1;
      for (size_t k = 0; k < 3; ++k) sum[second][k] += sign * tangent[k];
    }
    for (int i = 0; i < 2; ++i) {
      if (dot(sum[i], sum[i]) == 0) return std::nullopt;
      split.mean[i] = normalized(sum[i]);
    }
  }
  return split;
}

}  // namespace sobb::study
