// SPDX-License-Identifier: Apache-2.0
// Makes the foliage: trees with branches and many single leaves, on a plane.
#include <algorithm>
#include <vector>

#include "scene/builtin/scenes.h"

namespace sobb {
namespace {

constexpr double kHalf = 10;  // of the plane

struct Branch {
  Vec3 root;
  Vec3 tip;
  double sag = 0;
};

Vec3 along(const Branch& branch, double t) {
  return mix(branch.root, branch.tip, t) - Vec3{0, branch.sag * t * t, 0};
}

void write_branch(PartsWriter& parts, const Branch& branch, double radius, uint64_t segments,
                  uint64_t sides) {
  std::vector<Ring> rings;
  for (uint64_t i = 0; i <= segments; ++i) {
    const double t = double(i) / double(segments);
    rings.push_back({along(branch, t), radius * (1 - 0.75 * t)});
  }
  parts.tube(rings, sides);
}

// Writes a quad about its stem, in a random direction.
void write_leaf(PartsWriter& parts, Random& random, Vec3 at, double size) {
  const Vec3 length = size * random.direction();
  const Vec3 width = 0.55 * size * normalized(cross(length, random.direction()));
  parts.quad(at - 0.5 * width, at + length - 0.2 * width, at + length + 0.2 * width,
             at + 0.5 * width);
}

// Spends `budget` triangles: a fifth on wood, the rest on leaves.
void write_tree(PartsWriter& parts, Random& random, Vec3 foot, double height, uint64_t budget) {
  const bool fine = budget >= 1000;
  const uint64_t segments = fine ? 4 : 1;
  const uint64_t sides = fine ? 5 : 3;
  const uint64_t each = PartsWriter::tube_triangles(segments + 1, sides);
  const uint64_t branches = std::clamp<uint64_t>(budget / 5 / each, 3, 200);
  const Branch trunk{foot, foot + Vec3{random.uniform(-0.1, 0.1), 0.95 * height, 0}, 0};
  write_branch(parts, trunk, 0.035 * height, segments, sides);

  std::vector<Branch> made;
  double turn = random.uniform();
  for (uint64_t i = 0; i < branches; ++i) {
    turn += 0.381966 + random.uniform(-0.05, 0.05);  // the golden angle, as plants have it
    const double up = 0.25 + 0.7 * (double(i) + random.uniform()) / double(branches);
    // The crown is round, with the longest branches below its middle.
    const double reach = height * 0.75 * std::sqrt(up * (1.02 - up));
    const SinCos heading = sin_cos(turn);
    const Vec3 root = along(trunk, up);
    const Vec3 tip = root + reach * Vec3{heading.cos, random.uniform(0.2, 0.7), heading.sin};
    made.push_back({root, tip, 0.2 * reach});
    write_branch(parts, made.back(), 0.012 * height * (1.2 - up), segments, sides);
  }

  const uint64_t wood = (branches + 1) * each;
  const uint64_t leaves = budget > wood ? (budget - wood) / PartsWriter::kQuad : 0;
  const double size = std::min(0.2, 3.6 / std::sqrt(double(leaves + 1))) * height * 0.45;
  for (uint64_t i = 0; i < leaves; ++i) {
    const double t = random.uniform();
    const Branch& branch = made[random.below(made.size())];
    const double far = 0.09 * height * random.uniform();
    const Vec3 scatter = far * random.direction();
    write_leaf(parts, random, along(branch, 1 - 0.75 * t * t) + scatter, size);
  }
}

}  // namespace

void make_foliage(PartsWriter& parts) {
  parts.quad({-kHalf, 0, -kHalf}, {-kHalf, 0, kHalf}, {kHalf, 0, kHalf}, {kHalf, 0, -kHalf});
  // Trees stand in jittered rows; with more triangles there are more, and each has more leaves.
  uint64_t rows = 1;
  while ((rows + 1) * (rows + 1) * 400 <= parts.left() &&
         rows * rows * rows * rows < parts.left() / 250) {
    ++rows;
  }
  Random random(4);
  const double pitch = 2 * kHalf / double(rows);
  for (uint64_t i = 0; i < rows * rows; ++i) {
    const uint64_t row = i / rows;
    const double x = -kHalf + pitch * (double(i % rows) + random.uniform(0.25, 0.75));
    const double z = -kHalf + pitch * (double(row) + random.uniform(0.25, 0.75));
    const double height = std::min(3.5, 1.3 * pitch) * random.uniform(0.7, 1.1);
    write_tree(parts, random, {x, 0, z}, height, parts.left() / (rows * rows - i));
  }
}

}  // namespace sobb
