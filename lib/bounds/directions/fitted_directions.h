// SPDX-License-Identifier: Apache-2.0
// A direction table fitted to a scene: the well-spread set turned into a frame of the scene's own.
// (Dominant normals beside the frame's, in place of what is nearest to them in the set, change the
// triangles a ray tests by -4 to +6 %, by scene: they are not taken.)
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "bounds/basis.h"
#include "bounds/directions/direction_histogram.h"

namespace sobb {

// The frames that a scene may have, at most kMostFrames: the axes; every two perpendicular peaks,
// heaviest first, with their cross product; principal axes. Each is ordered and signed as near to
// the axes as can be.
inline constexpr size_t kMostFrames = 14;
std::pmr::vector<OrthogonalFrame> candidate_frames(std::span<const DirectionPeak> normals,
                                                   std::span<const DirectionPeak> edges,
                                                   std::span<const OrthogonalFrame> principal,
                                                   std::pmr::memory_resource& memory);

// The default set of k/2 directions, its axes turned to a frame's. As it is for the axes.
std::pmr::vector<Direction> turned_directions(uint32_t k, const OrthogonalFrame& frame,
                                              std::pmr::memory_resource& memory);

}  // namespace sobb
