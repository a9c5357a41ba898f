// SPDX-License-Identifier: Apache-2.0
// See parts.h.
#include "scene/builtin/parts.h"

#include <string>

#include "base/error.h"

namespace sobb {

PartsWriter::PartsWriter(SceneWriter& writer, uint64_t budget, const ObliqueTurn& turn)
    : writer_(writer), left_(budget), turn_(turn) {}

void PartsWriter::vertex(Vec3 p) {
  const Vec3 q = turn_.point(p);
  writer_.add_vertex(q.x, q.y, q.z, "made");
}

void PartsWriter::face(uint64_t a, uint64_t b, uint64_t c) {
  if (left_ == 0) fail(SOBB_ERROR_INTERNAL, "a built-in scene exceeds its triangles");
  --left_;
  const uint64_t corners[3] = {a, b, c};
  writer_.add_polygon(corners, "made");
}

void PartsWriter::quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const uint64_t base = writer_.vertex_count();
  for (const Vec3 p : {a, b, c, d}) vertex(p);
  face(base, base + 1, base + 2);
  face(base, base + 2, base + 3);
}

void PartsWriter::box(Vec3 low, Vec3 high) {
  const uint64_t base = writer_.vertex_count();
  for (int i = 0; i < 8; ++i) {
    vertex({(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
            (i & 4) != 0 ? high.z : low.z});
  }
  constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : kFaces) {
    face(base + f[0], base + f[1], base + f[2]);
    face(base + f[0], base + f[2], base + f[3]);
  }
}

// Each ring's axes are those of the ring before, turned as little as possible: tubes do not twist.
void PartsWriter::tube(std::span<const Ring> rings, uint64_t sides) {
  const uint64_t base = writer_.vertex_count();
  const uint64_t last = rings.size() - 1;
  Vec3 along{0, 0, 1};
  Vec3 across{1, 0, 0};
  for (uint64_t i = 0; i <= last; ++i) {
    const Vec3 ahead = rings[i < last ? i + 1 : i].centre - rings[i > 0 ? i - 1 : i].centre;
    if (dot(ahead, ahead) > 0) along = normalized(ahead);
    const Vec3 projected = across - dot(across, along) * along;
    across = dot(projected, projected) > 1e-6 ? normalized(projected) : perpendicular(along);
    const Vec3 third = cross(along, across);
    for (uint64_t k = 0; k < sides; ++k) {
      const SinCos angle = sin_cos(double(k) / double(sides));
      vertex(rings[i].centre + rings[i].radius * (angle.cos * across + angle.sin * third));
    }
  }
  for (uint64_t i = 0; i < last; ++i) {
    for (uint64_t k = 0; k < sides; ++k) {
      const uint64_t a = base + i * sides + k;
      const uint64_t b = base + i * sides + (k + 1) % sides;
      face(a, b, b + sides);
      face(a, b + sides, a + sides);
    }
  }
  const uint64_t end = base + last * sides;
  for (uint64_t k = 2; k < sides; ++k) {
    face(base, base + k, base + k - 1);
    face(end, end + k - 1, end + k);
  }
}

void PartsWriter::ellipsoid(Vec3 centre, Vec3 half_axes, uint64_t stacks) {
  const uint64_t base = writer_.vertex_count();
  const uint64_t around = 2 * stacks;
  const auto at = [&](double y, double x, double z) {
    vertex(centre + Vec3{half_axes.x * x, half_axes.y * y, half_axes.z * z});
  };
  at(1, 0, 0);
  at(-1, 0, 0);
  for (uint64_t i = 1; i < stacks; ++i) {
    const SinCos down = sin_cos(0.5 * double(i) / double(stacks));
    for (uint64_t k = 0; k < around; ++k) {
      const SinCos turn = sin_cos(double(k) / double(around));
      at(down.cos, down.sin * turn.cos, down.sin * turn.sin);
    }
  }
  const auto ring = [&](uint64_t i, uint64_t k) { return base + 2 + i * around + k % around; };
  for (uint64_t k = 0; k < around; ++k) {
    face(base, ring(0, k + 1), ring(0, k));
    face(base + 1, ring(stacks - 2, k), ring(stacks - 2, k + 1));
    for (uint64_t i = 0; i + 2 < stacks; ++i) {
      face(ring(i, k), ring(i, k + 1), ring(i + 1, k + 1));
      face(ring(i, k), ring(i + 1, k + 1), ring(i + 1, k));
    }
  }
}

}  // namespace sobb
