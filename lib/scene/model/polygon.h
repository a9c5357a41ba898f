// SPDX-License-Identifier: Apache-2.0
// Splits polygons into triangles: convex ones, and others that the fan about their first corner
// covers, into that fan; the rest by clipping ears.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "scene/model/vec3.h"

namespace sobb {

// Returns whether the fan about the first corner covers the polygon once, seen along the normal of
// its best-fit plane. What the fan covers beyond the polygon may be a millionth of its area, as
// rounded coordinates make it of straight edges.
bool fan_covers(std::span<const Vec3> corners);

// Returns the n - 2 triangles of a polygon of n corners, n from 3 on, as indices into `corners`, by
// clipping ears in the polygon's best-fit plane. They keep the polygon's orientation. Corners may
// lie on straight edges or on each other. Those of a polygon that crosses itself cover it somehow.
//
// `allowance` is called for every few thousand corners looked at, and returns how many more may be;
// where that is 0, the rest of the polygon becomes a fan. It may throw.
std::vector<uint32_t> clip_ears(std::span<const Vec3> corners,
                                std::function<size_t()> allowance = nullptr);

// The most bytes that clip_ears() takes for a polygon.
constexpr uint64_t ear_clipping_bytes(uint64_t corners) { return 16384 + 256 * corners; }

}  // namespace sobb
