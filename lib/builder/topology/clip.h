// SPDX-License-Identifier: Apache-2.0
// Triangles cut by planes along the axes of the topology's frame, for spatial splits. Always
// outward: the parts of a triangle cover it.
#pragma once

#include "builder/topology/box.h"

namespace sobb {

// The boxes of a triangle's parts below and above `position` along `axis`, within `box`.
void split_box(const Corners& triangle, const Box& box, int axis, float position, Box& below,
               Box& above);

// The polygon that a triangle has in common with a box, in the mesh's coordinates; at most nine
// vertices. The box is grown by the rounding of the cuts, so that the polygon covers the exact one.
// Returns the vertex count.
int clip_to_box(const Corners& triangle, const Box& box, double polygon[9][3]);

}  // namespace sobb
