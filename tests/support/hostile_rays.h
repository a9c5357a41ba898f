// SPDX-License-Identifier: Apache-2.0
// Seeded rays for which a careless tracer loses hits: each family strains one step of the argument
// in docs/robustness.md.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "support/soups.h"

namespace sobb::test {

enum class RayFamily {
  kVertices,   // from all around through vertices: which of the triangles there, and none lost
  kEdges,      // through points of edges, and along edges from before their ends
  kInPlane,    // in the plane of a triangle, as floats come
  kAlongSlab,  // perpendicular, within zero to some ulps, to a slab's normal: n . d is all rounding
  kAcrossSlab,  // along a normal of the table
  kZeros,       // components +0, -0, denormal, tiny and huge beside ordinary ones
  kFromPoint,   // bundles from one origin, as packets take them, in directions of any length
  kToPoint,     // bundles that end at one point
  kDistant      // from 1e-6 to 1e6 of the scene's size away
};

inline constexpr std::array kRayFamilies = {
    RayFamily::kVertices,  RayFamily::kEdges,      RayFamily::kInPlane,
    RayFamily::kAlongSlab, RayFamily::kAcrossSlab, RayFamily::kZeros,
    RayFamily::kFromPoint, RayFamily::kToPoint,    RayFamily::kDistant};

// `normals` are those of the table that the rays are traced with.
std::vector<sobb_ray> hostile_rays(const Soup& soup, RayFamily family,
                                   std::span<const std::array<float, 3>> normals, uint64_t seed,
                                   uint32_t count);

}  // namespace sobb::test
