// SPDX-License-Identifier: Apache-2.0
// Finds which corners of a scene's triangles are one vertex of a manifold: subdivision needs that,
// and files do not promise it.
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
  std::vector<uint32_t> vertex_of_corner;  // three corners per triangle
  std::vector<uint32_t> scene_vertex;      // per vertex, one of the scene's at its place
  uint64_t edge_count = 0;
  uint64_t most_edges = 0;  // about one vertex
};

// For at most 2^30 triangles. `writer` bounds the memory that is needed for a while, and reports
// progress. Errors: CANCELLED, MEMORY_LIMIT.
ManifoldCorners find_manifold_corners(const Scene& scene, SceneWriter& writer);

}  // namespace sobb
