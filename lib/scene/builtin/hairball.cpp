// SPDX-License-Identifier: Apache-2.0
// Makes the hairball: strands that wander about a ball, one over another.
#include <algorithm>
#include <vector>

#include "scene/builtin/scenes.h"

namespace sobb {
namespace {

constexpr uint64_t kSides = 3;
constexpr double kStep = 0.1;  // radians about the ball from ring to ring

// Writes a strand along a great circle that keeps turning, at a distance that swells and sinks.
void write_strand(PartsWriter& parts, Random& random, uint64_t segments, double radius) {
  Vec3 up = random.direction();
  Vec3 ahead = perpendicular(up);
  const SinCos heading = sin_cos(random.uniform());
  ahead = heading.cos * ahead + heading.sin * cross(up, ahead);
  const double depth = random.uniform();
  const double distance = 0.95 - 0.35 * depth * depth;
  const double bend = random.uniform(-0.12, 0.12);
  const double waves = random.uniform(0.01, 0.04);  // turns per ring
  const double phase = random.uniform();

  std::vector<Ring> rings;
  for (uint64_t i = 0; i <= segments; ++i) {
    const SinCos wave = sin_cos(phase + waves * double(i));
    const double taper = i == 0 || i == segments ? 0.4 : 1;
    rings.push_back({(distance + 0.05 * wave.sin) * up, taper * radius});
    const Vec3 moved = up + kStep * ahead;
    const Vec3 side = cross(up, ahead);
    up = normalized(moved);
    const Vec3 turned = ahead + (bend + 0.1 * wave.cos) * side;
    ahead = normalized(turned - dot(turned, up) * up);
  }
  parts.tube(rings, kSides);
}

}  // namespace

void make_hairball(PartsWriter& parts) {
  const uint64_t segments = std::clamp<uint64_t>(parts.left() / 300, 2, 48);
  const uint64_t each = PartsWriter::tube_triangles(segments + 1, kSides);
  const uint64_t strands = parts.left() / each;
  // More strands are thinner, but not so much that they would cover no more of the ball.
  const double radius = std::min(0.03, 0.12 / std::sqrt(double(strands)));
  Random random(1);
  while (parts.left() >= each) write_strand(parts, random, segments, radius);
  const uint64_t rest = parts.left() / (2 * kSides);
  if (rest >= 2) write_strand(parts, random, rest - 1, radius);
}

}  // namespace sobb
