// SPDX-License-Identifier: Apache-2.0
// The scalar oracle: every ray against every triangle. Right by definition.
#pragma once

#include <cstdint>

#include "base/scheduler.h"
#include "builder/mesh.h"
#include "sobb/sobb.h"

namespace sobb {

// Closest hits. Returns how many rays were not valid.
uint64_t brute_force(const Mesh& mesh, const sobb_ray* rays, uint64_t count, sobb_hit* hits,
                     const Scheduler& scheduler);

}  // namespace sobb
