// SPDX-License-Identifier: Apache-2.0
// Writes the parts that built-in scenes are made of as triangles, within a budget.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/model/oblique_turn.h"
#include "scene/model/scene_writer.h"
#include "scene/model/vec3.h"

namespace sobb {

// A cross-section of a tube.
struct Ring {
  Vec3 centre;
  double radius = 0;
};

class PartsWriter {
 public:
  PartsWriter(SceneWriter& writer, uint64_t budget, const ObliqueTurn& turn);

  // The triangles of the budget that are left.
  uint64_t left() const { return left_; }

  // The parts, and the triangles that each takes of the budget. A part beyond the budget is an
  // internal error: scenes ask left() first.
  void quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d);
  static constexpr uint64_t kQuad = 2;
  void box(Vec3 low, Vec3 high);  // along the axes
  static constexpr uint64_t kBox = 12;
  void tube(std::span<const Ring> rings, uint64_t sides);  // both ends closed
  static constexpr uint64_t tube_triangles(uint64_t rings, uint64_t sides) {
    return 2 * sides * (rings - 1) + 2 * (sides - 2);
  }
  void ellipsoid(Vec3 centre, Vec3 half_axes, uint64_t stacks);
  static constexpr uint64_t ellipsoid_triangles(uint64_t stacks) {
    return 4 * stacks * (stacks - 1);
  }
  // Quads between (rows + 1) x (columns + 1) points, which point(row, column) gives.
  template <class Point>
  void grid(uint64_t rows, uint64_t columns, const Point& point) {
    const uint64_t base = writer_.vertex_count();
    for (uint64_t i = 0; i <= rows; ++i) {
      for (uint64_t j = 0; j <= columns; ++j) vertex(point(i, j));
    }
    for (uint64_t i = 0; i < rows; ++i) {
      for (uint64_t j = 0; j < columns; ++j) {
        const uint64_t a = base + i * (columns + 1) + j;
        const uint64_t b = a + columns + 1;
        face(a, b, b + 1);
        face(a, b + 1, a + 1);
      }
    }
  }

 private:
  void vertex(Vec3 p);
  void face(uint64_t a, uint64_t b, uint64_t c);

  SceneWriter& writer_;
  uint64_t left_;
  const ObliqueTurn& turn_;
};

}  // namespace sobb
