// SPDX-License-Identifier: Apache-2.0
// Closed surfaces, each vertex shared by all its triangles, and rays that must not get out.
#pragma once

#include <vector>

#include "support/soups.h"

namespace sobb::test {

struct ClosedMesh {
  Soup soup;
  double centre[3];
  double radius;  // of a ball inside of it
};

// A box, spheres of ordinary triangles and of slivers, one with spikes, one far from the origin,
// one tiny.
std::vector<ClosedMesh> closed_meshes();

// From within the ball: to anywhere, to vertices, to points of edges.
std::vector<sobb_ray> rays_from_inside(const ClosedMesh& mesh, uint64_t seed, size_t count);

}  // namespace sobb::test
