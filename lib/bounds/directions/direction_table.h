// SPDX-License-Identifier: Apache-2.0
// The K = k/2 unit normals that slabs are measured along.
#pragma once

#include <cstdint>
#include <span>

#include "bounds/basis.h"

namespace sobb {

// Up to 32 directions as structure of arrays, padded with zeros to whole vectors.
struct alignas(64) DirectionTable {
  float x[kMaxDirections] = {};
  float y[kMaxDirections] = {};
  float z[kMaxDirections] = {};
  uint32_t count = 0;
};

DirectionTable make_direction_table(std::span<const Direction> directions);

// The default set for a k-DOP of k = 6 (the axes), 32, 48, 64, 128 or 256 planes. Sets begin with
// the axes; the rest was optimised by scripts/direction_tables.py, which prints smallest angle and
// covering radius. Those for 128 and 256 are for studies: no DirectionTable and no file holds them.
std::span<const Direction> default_directions(uint32_t k);

}  // namespace sobb
