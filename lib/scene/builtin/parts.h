// SPDX-License-Identifier: Apache-2.0
// The parts that built-in scenes are made of, written out as triangles within a budget.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/builtin/math.h"
#include "scene/oblique_turn.h"
#include "scene/scene_writer.h"

namespace sobb {

struct Ring {
  Vec3 centre;
  double radius = 0;
};

class PartsWriter {
 public:
  PartsWriter(SceneWriter& writer, uint64_t budget, const ObliqueTurn& turn);

  // Triangles that may yet come.
  uint64_t left() const { return left_; }

  // Parts, and what each takes of the budget. A part beyond it is an internal error: scenes ask
  // first.
  void quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d);  // 2
  static constexpr uint64_t kQuad = 2;
  void box(Vec3 low, Vec3 high);  // 12, along the axes
  static constexpr uint64_t kBox = 12;
  void tube(std::span<const Ring> rings, uint64_t sides);  // both ends closed
  static constexpr uint64_t tube_triangles(uint64_t rings, uint64_t sides) {
    return 2 * sides * (rings - 1) + 2 * (sides - 2);
  }
  void ellipsoid(Vec3 centre, Vec3 half_axes, uint64_t stacks);
  static constexpr uint64_t ellipsoid_triangles(uint64_t stacks) {
    return 4 * stacks * (stacks - 1);
  }
  // (rows + 1) x (columns + 1) points, `point(row, column)`.
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
