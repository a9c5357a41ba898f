// SPDX-License-Identifier: Apache-2.0
// Triangles cut by planes across the axes of the topology's frame, for spatial splits. Cuts round
// outward: the parts of a triangle cover it.
#pragma once

#include "builder/boxes/box.h"

namespace sobb {

// Computes the boxes of a triangle's parts below and above `position` along `axis`, within `box`. A
// box without a part is inside out.
void split_box(const Corners& triangle, const Box& box, int axis, float position, Box& below,
               Box& above);

// Computes the polygon that a triangle and a box have in common, in the mesh's coordinates, and
// returns its number of vertices. The box is grown by the rounding of the cuts, so that the polygon
// covers the exact one. A triangle that lies in the box is its own polygon, corner for corner.
int clip_to_box(const Corners& triangle, const Box& box, double polygon[9][3]);

}  // namespace sobb
