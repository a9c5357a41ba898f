// SPDX-License-Identifier: Apache-2.0
// A scene in memory: indexed triangles, the meshes that are ranges of them, and views.
//
// The room model/ is the ground that the other rooms stand on: what a scene is, the writer that
// every reader fills it through, and what is measured of it or done to all of it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/model/vec3.h"
#include "sobb/scene.h"

namespace sobb {

// No coordinate of a vertex is larger in magnitude.
inline constexpr float kLargestCoordinate = 0x1p60F;

struct SceneMesh {
  std::string name;  // UTF-8
  uint64_t first_triangle = 0;
  uint64_t triangle_count = 0;
};

// What a reader passed over for one cause, see sobb_scene_note.
struct SceneNote {
  sobb_note_cause cause;
  uint64_t count;
  std::string first;
};

struct Scene {
  std::vector<float> vertices;    // x, y, z
  std::vector<uint32_t> indices;  // three per triangle
  std::vector<SceneMesh> meshes;  // in order, disjoint, covering all triangles, none empty
  std::vector<sobb_view> views;
  bool default_view = false;     // the one view was made, not read
  std::vector<SceneNote> notes;  // at most one per cause, in the order of causes

  // SceneWriter::finish() measures these.
  uint64_t degenerate_count = 0;
  std::array<float, 3> bounds_min{};  // of the vertices that triangles use
  std::array<float, 3> bounds_max{};
};

// A perspective camera of a file, as placed in the scene. `forward` and `up` have any length.
struct SceneCamera {
  Vec3 eye;
  Vec3 forward;
  Vec3 up;
  double vfov_radians = 0;  // the whole vertical angle
};

}  // namespace sobb
