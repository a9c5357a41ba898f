// SPDX-License-Identifier: Apache-2.0
// The direction table fitted to a mesh: the default set, turned into the frame that the mesh's
// normals, weighted by area, or its edges, weighted by length, suggest.
#pragma once

#include <cstdint>
#include <memory_resource>

#include "base/scheduler.h"
#include "bounds/directions/direction_table.h"
#include "builder/mesh.h"

namespace sobb {

// Chooses k/2 directions, of which the first three are perpendicular. Where no frame is better than
// the axes it is the default set, a spread table. Looks at 16,384 triangles at most, in parallel;
// the result is the same for any number of threads.
DirectionSet scene_directions(const Mesh& mesh, uint32_t k, const Scheduler& scheduler,
                              std::pmr::memory_resource& memory);

}  // namespace sobb
