// SPDX-License-Identifier: Apache-2.0
// A direction table fitted to a scene: the default set, turned into a frame of the scene's own.
// (If the scene's dominant normals replace the directions nearest to them in the set, the triangles
// tested per ray change by -4 to +6 %, by scene. So they do not.)
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "bounds/basis.h"
#include "bounds/directions/direction_histogram.h"

namespace sobb {

// Lists the frames that a scene may have, at most kMostFrames: first the axes, then every two
// perpendicular peaks with their cross product, heaviest first, then the principal axes. The three
// directions of each are ordered and signed to be as near to the axes as can be.
inline constexpr size_t kMostFrames = 14;
std::pmr::vector<OrthogonalFrame> candidate_frames(std::span<const DirectionPeak> normals,
                                                   std::span<const DirectionPeak> edges,
                                                   std::span<const OrthogonalFrame> principal,
                                                   std::pmr::memory_resource& memory);

// The default set of k/2 directions, its axes turned to a frame's.
std::pmr::vector<Direction> turned_directions(uint32_t k, const OrthogonalFrame& frame,
                                              std::pmr::memory_resource& memory);

}  // namespace sobb
