// SPDX-License-Identifier: Apache-2.0
#include "builder/volumes/leaf.h"

#include "builder/topology/clip.h"

namespace sobb {
namespace {

// Relative to the centre: the difference of two floats is exact enough in double to be rounded
// once.
RelativePoint relative(const double point[3], const float centre[3]) {
  return {static_cast<float>(point[0] - centre[0]), static_cast<float>(point[1] - centre[1]),
          static_cast<float>(point[2] - centre[2])};
}

}  // namespace

void fit_leaf(const Mesh& mesh, const References& leaf, const DirectionTable& directions,
              const float centre[3], const BoundsKernels& kernels, Kdop& kdop, const Frame& frame) {
  RelativePoint points[9 * kMaxLeafReferences];
  uint64_t count = 0;
  for (size_t i = 0; i < leaf.primitives.size(); ++i) {
    const uint32_t primitive = leaf.primitives[i];
    if (leaf.boxes.empty() || leaf.boxes[i] == box_of(mesh, primitive, frame)) {
      for (int j = 0; j < 3; ++j) {
        const Point p = mesh.corner(primitive, j);
        const double point[3] = {p.x, p.y, p.z};
        points[count++] = relative(point, centre);
      }
    } else {
      double polygon[9][3];
      const int polygon_count =
          clip_to_box(Corners(mesh, primitive, frame), leaf.boxes[i], polygon);
      for (int j = 0; j < polygon_count; ++j) points[count++] = relative(polygon[j], centre);
    }
  }
  if (count == 0) {
    // Every reference's box misses its triangle: nothing can be hit here, but a volume there is.
    const float* corner = leaf.boxes[0].lower;
    const double at[3] = {corner[0], corner[1], corner[2]};
    double point[3];
    frame.turn_back(at, point);
    points[count++] = relative(point, centre);
  }
  kernels.fit(directions, points, count, kdop);
}

void write_blocks(const Mesh& mesh, std::span<const uint32_t> primitives, TriangleBlock* blocks) {
  for (uint64_t i = 0; i < blocks_of(primitives.size()); ++i) {
    for (uint64_t lane = 0; lane < 4; ++lane) {
      const uint64_t at = 4 * i + lane;
      if (at >= primitives.size()) {
        blocks[i].primitive[lane] = kNoPrimitive;
        continue;
      }
      const uint32_t primitive = primitives[at];
      for (int vertex = 0; vertex < 3; ++vertex) {
        const Point corner = mesh.corner(primitive, vertex);
        blocks[i].vertex[vertex][0][lane] = corner.x;
        blocks[i].vertex[vertex][1][lane] = corner.y;
        blocks[i].vertex[vertex][2][lane] = corner.z;
      }
      blocks[i].primitive[lane] = primitive;
    }
  }
}

}  // namespace sobb
