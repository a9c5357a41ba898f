// SPDX-License-Identifier: Apache-2.0
// The K = k/2 unit normals that slabs are measured along: the library's own sets, and their forms.
//
// The room `bounds/directions` makes such tables: direction_histogram finds the directions that
// triangles prefer, principal_axes and fitted_directions make candidate frames of them, and turn
// the library's own set into a frame. It knows directions only, no mesh; `builder/scene_directions`
// brings the triangles.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "bounds/basis.h"
#include "sobb/sobb.h"

namespace sobb {

// Up to 32 directions as structure of arrays, padded with zeros to whole vectors.
struct alignas(64) DirectionTable {
  float x[kMaxDirections] = {};
  float y[kMaxDirections] = {};
  float z[kMaxDirections] = {};
  uint32_t count = 0;
};

DirectionTable make_direction_table(std::span<const Direction> directions);

// The default set for a k-DOP of k = 6 (the axes), 32, 48, 64, 128 or 256 planes. Each set begins
// with the axes; the rest was optimised by scripts/direction_tables.py, which prints the smallest
// angle and the covering radius. The sets for 128 and 256 serve studies: no DirectionTable and no
// file holds them.
std::span<const Direction> default_directions(uint32_t k);

// Directions chosen for a hierarchy, and how they were chosen.
struct DirectionSet {
  std::pmr::vector<Direction> directions;
  sobb_table table;  // SOBB_TABLE_SPREAD: the default set, whose first three are the axes
};

DirectionSet default_direction_set(uint32_t k, std::pmr::memory_resource& memory);

// Tells which table a file has. A file holds the directions alone, so they are compared with the
// default set of as many.
sobb_table table_of_file(std::span<const Direction> directions);

}  // namespace sobb
