// SPDX-License-Identifier: Apache-2.0
// Which corners of a scene's triangles are one vertex of a manifold: what subdivision needs, and
// what files do not promise.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/model/scene.h"
#include "scene/model/scene_writer.h"

namespace sobb {

// Vertices at the same place are one (-0 is 0). Two triangles are neighbours at an edge that is
// theirs alone and that they run through in opposite directions; elsewhere the surface ends. The
// triangles about a vertex that are neighbours of each other make a fan, and each fan has a vertex
// of its own; so has each corner of a triangle with two corners at one place. No triangle is lost,
// and the order of triangles does not matter.
struct ManifoldCorners {
  std::vector<uint32_t> vertex_of_corner;  // of 3 corners a triangle
  std::vector<uint32_t> scene_vertex;      // of each vertex: the scene's, for its place
  uint64_t edge_count = 0;
  uint64_t most_edges = 0;  // about one vertex
};

// Asks `writer` for the room that it needs for a while, and whether to go on. At most 2^30
// triangles. Errors: CANCELLED, MEMORY_LIMIT.
ManifoldCorners find_manifold_corners(const Scene& scene, SceneWriter& writer);

}  // namespace sobb
