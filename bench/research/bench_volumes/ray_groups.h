// SPDX-License-Identifier: Apache-2.0
// The rays of a run are made once and are the same for every method, as are the hits.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "ray_sets.h"
#include "scene_input.h"

namespace sobb::bench::volumes {

struct RayGroup {
  std::string name;
  std::vector<sobb_ray> rays;
  std::vector<sobb_hit> hits;  // found by the first method
};

inline constexpr size_t kGroups = 2;
using RayGroups = std::array<RayGroup, kGroups>;

/// `primary`, and `secondary`: all bounces 1 to 7 of one path per pixel. Throws where a group is
/// empty.
RayGroups make_ray_groups(const SceneInput& scene, uint32_t size, const ClosestHits& closest_hits);

/// Throws where the hits that @p method found are not the group's, bit by bit, with the first ray
/// that differs.
void expect_same_hits(const std::string& method, const RayGroup& group,
                      const std::vector<sobb_hit>& hits);

/// Compares the group's hits, which @p method found, with brute force for 100 evenly spread rays.
/// Returns how many rays it compared; throws where one differs.
uint64_t expect_brute_force(const std::string& method, const RayGroup& group,
                            const sobb_triangles& triangles, uint32_t threads);

}  // namespace sobb::bench::volumes
