// SPDX-License-Identifier: Apache-2.0
// Makes the pipes: long thin tubes with elbows and flanges, along the axes and at all angles.
#include <algorithm>
#include <vector>

#include "scene/builtin/scenes.h"

namespace sobb {
namespace {

constexpr Vec3 kHalf{2, 1, 2};  // of the box they fill
constexpr uint64_t kElbow = 4;  // segments of an elbow
constexpr uint64_t kMostRuns = 6;

// A pipe has two flanges, and an elbow between each two runs.
constexpr uint64_t ring_count(uint64_t runs) { return 6 + (kElbow + 1) * (runs - 1); }

// The end of the next run. Half of all runs go along the axes, as pipes in buildings do; one that
// would leave the box is mirrored.
Vec3 next_corner(Random& random, Vec3 from, Vec3 last_direction) {
  for (;;) {
    Vec3 d = random.direction();
    if (random.uniform() < 0.5) {
      const uint64_t axis = random.below(3);
      const double sign = random.uniform() < 0.5 ? -1 : 1;
      d = {axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0};
    }
    const double size = random.uniform(0.35, 1.8);
    const auto step = [size](double at, double along, double half) {
      const double to = at + size * along;
      return to > half || to < -half ? at - size * along : to;
    };
    const Vec3 to{step(from.x, d.x, kHalf.x), step(from.y, d.y, kHalf.y),
                  step(from.z, d.z, kHalf.z)};
    const bool inside = to.x * to.x <= kHalf.x * kHalf.x && to.y * to.y <= kHalf.y * kHalf.y &&
                        to.z * to.z <= kHalf.z * kHalf.z;
    const double bend = dot(normalized(to - from), last_direction);
    if (inside && bend < 0.95 && bend > -0.6) return to;  // neither straight on nor sharply back
  }
}

void write_pipe(PartsWriter& parts, Random& random, uint64_t runs, uint64_t sides, double radius) {
  std::vector<Vec3> corners;
  corners.push_back({random.uniform(-kHalf.x, kHalf.x), random.uniform(-kHalf.y, kHalf.y),
                     random.uniform(-kHalf.z, kHalf.z)});
  Vec3 direction{};
  for (uint64_t i = 0; i < runs; ++i) {
    corners.push_back(next_corner(random, corners.back(), direction));
    direction = normalized(corners[i + 1] - corners[i]);
  }

  std::vector<Ring> rings;
  const auto flange = [&](Vec3 end, Vec3 inward, bool first) {
    const Ring face{end, 1.8 * radius};
    const Ring back{end + radius * inward, 1.8 * radius};
    const Ring pipe{end + 1.1 * radius * inward, radius};
    for (const Ring& ring : first ? std::vector{face, back, pipe} : std::vector{pipe, back, face}) {
      rings.push_back(ring);
    }
  };
  flange(corners[0], normalized(corners[1] - corners[0]), true);
  for (uint64_t i = 1; i < runs; ++i) {
    // The elbow is a quadratic curve between the runs.
    const double reach = 6 * radius < 0.12 ? 6 * radius : 0.12;
    const Vec3 in = corners[i] - reach * normalized(corners[i] - corners[i - 1]);
    const Vec3 out = corners[i] + reach * normalized(corners[i + 1] - corners[i]);
    for (uint64_t k = 0; k <= kElbow; ++k) {
      const double t = double(k) / double(kElbow);
      rings.push_back({mix(mix(in, corners[i], t), mix(corners[i], out, t), t), radius});
    }
  }
  flange(corners[runs], normalized(corners[runs - 1] - corners[runs]), false);
  parts.tube(rings, sides);
}

}  // namespace

void make_pipes(PartsWriter& parts) {
  const uint64_t sides = parts.left() < 2000 ? 3 : parts.left() < 50'000 ? 6 : 8;
  const auto triangles = [&](uint64_t runs) {
    return PartsWriter::tube_triangles(ring_count(runs), sides);
  };
  const double pipes = double(parts.left()) / double(triangles(4)) + 1;
  const double thickness = 0.3 / std::sqrt(pipes);
  Random random(3);
  while (parts.left() >= triangles(1)) {
    uint64_t runs = 2 + random.below(kMostRuns - 1);
    while (triangles(runs) > parts.left()) --runs;
    const double radius = std::min(0.03, thickness) * random.uniform(0.5, 1.5);
    write_pipe(parts, random, runs, sides, radius);
  }
}

}  // namespace sobb
