// SPDX-License-Identifier: Apache-2.0
// A scene in memory: indexed triangles, the ranges that meshes have of them, and views.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sobb/scene.h"

namespace sobb {

struct SceneMesh {
  std::string name;  // UTF-8
  uint64_t first_triangle = 0;
  uint64_t triangle_count = 0;
};

struct Scene {
  std::vector<float> vertices;    // x, y, z
  std::vector<uint32_t> indices;  // three a triangle
  std::vector<SceneMesh> meshes;  // in order, disjoint, covering all triangles, none empty
  std::vector<sobb_view> views;
  bool default_view = false;  // the one view was made, not read

  // Of the finished scene, by SceneWriter::finish().
  uint64_t degenerate_count = 0;
  std::array<float, 3> bounds_min{};  // of the vertices that triangles use
  std::array<float, 3> bounds_max{};
};

}  // namespace sobb
