// SPDX-License-Identifier: Apache-2.0
// The direction table fitted to a mesh: the spread set in the frame that the mesh's normals,
// weighted by area, or its edges, weighted by length, suggest.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "base/scheduler.h"
#include "bounds/basis.h"
#include "builder/mesh.h"

namespace sobb {

// k/2 directions, the first three perpendicular; the default ones where no frame is better than the
// axes. From 16,384 of the triangles at most, in parallel, the same for any number of threads.
std::pmr::vector<Direction> scene_directions(const Mesh& mesh, uint32_t k,
                                             const Scheduler& scheduler,
                                             std::pmr::memory_resource& memory);

}  // namespace sobb
