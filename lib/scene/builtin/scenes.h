// SPDX-License-Identifier: Apache-2.0
// The built-in scenes, each in a file of its own.
#pragma once

#include "scene/builtin/parts.h"
#include "scene/builtin/random.h"

namespace sobb {

// Each function spends the writer's budget, at least kLeastTriangles, on parts about the origin, y
// up.
inline constexpr uint64_t kLeastTriangles = 100;

void make_hairball(PartsWriter& parts);  // strands wound about a ball of radius 1
void make_wool(PartsWriter& parts);      // short curls, tightly packed on a sheep 2 long
void make_pipes(PartsWriter& parts);     // long thin tubes at all angles, in a box of 4 x 2 x 4
void make_foliage(PartsWriter& parts);   // trees on a plane of 20 x 20
void make_city(PartsWriter& parts);      // buildings in rows on a plane of 20 x 20
void make_terrain(PartsWriter& parts);   // mountains, a height field of 20 x 20

}  // namespace sobb
