// SPDX-License-Identifier: Apache-2.0
// Makes the wool: short curls, tightly packed on rounded bodies that make a sheep.
#include <algorithm>
#include <array>
#include <vector>

#include "scene/builtin/scenes.h"

namespace sobb {
namespace {

constexpr uint64_t kSides = 3;

struct Body {
  Vec3 centre;
  Vec3 half_axes;
  double share;   // of the curls
  double length;  // of a curl
};

constexpr std::array<Body, 9> kBodies = {{
    {{0, 0.85, 0}, {0.48, 0.42, 0.74}, 0.88, 0.13},     // trunk
    {{0, 1.22, 0.78}, {0.19, 0.21, 0.24}, 0.12, 0.08},  // crown of the head
    {{0, 1.12, 0.99}, {0.12, 0.13, 0.2}, 0, 0},         // face
    {{0.24, 0.3, 0.42}, {0.085, 0.32, 0.085}, 0, 0},    // legs
    {{-0.24, 0.3, 0.42}, {0.085, 0.32, 0.085}, 0, 0},   //
    {{0.24, 0.3, -0.42}, {0.085, 0.32, 0.085}, 0, 0},   //
    {{-0.24, 0.3, -0.42}, {0.085, 0.32, 0.085}, 0, 0},
    {{0.22, 1.24, 0.84}, {0.13, 0.035, 0.06}, 0, 0},  // ears
    {{-0.22, 1.24, 0.84}, {0.13, 0.035, 0.06}, 0, 0},
}};

// Writes a helix that leans with the wool: away from the body, down and back.
void write_curl(PartsWriter& parts, Random& random, const Body& body, uint64_t segments,
                double radius) {
  const Vec3 on = random.direction();
  const Vec3& h = body.half_axes;
  const Vec3 root = body.centre + Vec3{h.x * on.x, h.y * on.y, h.z * on.z};
  const Vec3 normal = normalized({on.x / h.x, on.y / h.y, on.z / h.z});
  const Vec3 lean = normal + 0.5 * Vec3{0, -0.8, -0.6} + 0.35 * random.direction();
  const Vec3 axis = dot(lean, normal) > 0.2 ? normalized(lean) : normal;
  const Vec3 across = perpendicular(axis);
  const Vec3 third = cross(axis, across);
  const double size = body.length * random.uniform(0.7, 1.2);
  const double curl = 0.12 * size;
  const double turns = random.uniform(1.0, 1.8);
  const double phase = random.uniform();

  std::vector<Ring> rings;
  for (uint64_t i = 0; i <= segments; ++i) {
    const double t = double(i) / double(segments);
    const SinCos angle = sin_cos(phase + turns * t);
    const Vec3 offset = curl * t * (angle.cos * across + angle.sin * third);
    rings.push_back({root + (size * t) * axis + offset, radius * (1.1 - 0.8 * t)});
  }
  parts.tube(rings, kSides);
}

}  // namespace

void make_wool(PartsWriter& parts) {
  // The skin below the curls takes at most a quarter of the triangles.
  uint64_t stacks = 2;
  const auto skin = [](uint64_t n) { return kBodies.size() * PartsWriter::ellipsoid_triangles(n); };
  while (stacks < 40 && skin(stacks + 1) * 25 <= parts.left()) ++stacks;
  for (const Body& body : kBodies) parts.ellipsoid(body.centre, body.half_axes, stacks);

  const uint64_t segments = parts.left() < 5000 ? 2 : 6;
  const uint64_t each = PartsWriter::tube_triangles(segments + 1, kSides);
  const uint64_t curls = parts.left() / each + 1;
  const double radius = std::min(0.02, 0.5 / std::sqrt(double(curls)));
  Random random(2);
  while (parts.left() >= each) {
    double choice = random.uniform();
    size_t body = 0;
    while (body + 1 < kBodies.size() && choice >= kBodies[body].share) {
      choice -= kBodies[body++].share;
    }
    if (kBodies[body].share > 0) write_curl(parts, random, kBodies[body], segments, radius);
  }
}

}  // namespace sobb
