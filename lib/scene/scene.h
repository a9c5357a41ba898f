// SPDX-License-Identifier: Apache-2.0
// A scene in memory: indexed triangles, the ranges that meshes have of them, and views.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sobb/scene.h"

namespace sobb {

struct SceneMesh {
  std::string name;
  uint64_t first_triangle = 0;
  uint64_t triangle_count = 0;
};

struct Scene {
  std::vector<float> vertices;    // x, y, z
  std::vector<uint32_t> indices;  // three a triangle
  std::vector<SceneMesh> meshes;  // in order, disjoint, covering all triangles
  std::vector<sobb_view> views;
  bool default_view = false;  // the one view was made, not read
};

}  // namespace sobb
