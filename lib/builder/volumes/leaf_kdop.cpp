// SPDX-License-Identifier: Apache-2.0
#include "builder/volumes/leaf_kdop.h"

#include "builder/boxes/clip.h"

namespace sobb {
namespace {

// Takes a point relative to the centre: the difference of two floats is exact enough in double to
// be rounded once.
RelativePoint relative(const double point[3], const float centre[3]) {
  return {static_cast<float>(point[0] - centre[0]), static_cast<float>(point[1] - centre[1]),
          static_cast<float>(point[2] - centre[2])};
}

}  // namespace

void fit_leaf(const Mesh& mesh, const References& leaf, const DirectionTable& directions,
              const float centre[3], const BoundsKernels& kernels, Kdop& kdop, const Frame& frame) {
  RelativePoint points[9 * kMaxLeafReferences];
  uint64_t count = 0;
  for (size_t i = 0; i < leaf.size(); ++i) {
    const uint32_t primitive = leaf.primitives[i];
    if (leaf.is_cut(i)) {
      double polygon[9][3];
      const int polygon_count = clip_to_box(Corners(mesh, primitive, frame), leaf.cuts[i], polygon);
      for (int j = 0; j < polygon_count; ++j) points[count++] = relative(polygon[j], centre);
    } else {
      for (int j = 0; j < 3; ++j) {
        const Point p = mesh.corner(primitive, j);
        const double point[3] = {p.x, p.y, p.z};
        points[count++] = relative(point, centre);
      }
    }
  }
  if (count == 0) {
    // Every reference's box misses its triangle. Nothing can be hit here, but the leaf still needs
    // a volume.
    const float* corner = leaf.cuts[0].lower;
    const double at[3] = {corner[0], corner[1], corner[2]};
    double point[3];
    frame.turn_back(at, point);
    points[count++] = relative(point, centre);
  }
  kernels.fit(directions, points, count, kdop);
}

}  // namespace sobb
