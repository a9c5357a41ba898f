// SPDX-License-Identifier: Apache-2.0
// The default direction sets, and a set's form for kernels.
#include "bounds/directions/direction_table.h"

#include <algorithm>

#include "base/error.h"

namespace sobb {
namespace {

constexpr Direction kAxes[] = {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};

#include "bounds/directions/direction_sets.inc"

}  // namespace

DirectionTable make_direction_table(std::span<const Direction> directions) {
  if (directions.empty() || directions.size() > kMaxDirections) {
    fail(SOBB_ERROR_INVALID_ARGUMENT, "a direction table of %zu directions; it holds 1 to %u",
         directions.size(), kMaxDirections);
  }
  DirectionTable table;
  for (const Direction& direction : directions) {
    table.x[table.count] = direction.x;
    table.y[table.count] = direction.y;
    table.z[table.count] = direction.z;
    ++table.count;
  }
  return table;
}

std::span<const Direction> default_directions(uint32_t k) {
  switch (k) {
    case 6:
      return kAxes;
    case 32:
      return kDirections16;
    case 48:
      return kDirections24;
    case 64:
      return kDirections32;
    case 128:
      return kDirections64;
    case 256:
      return kDirections128;
  }
  fail(SOBB_ERROR_INVALID_ARGUMENT,
       "no default directions for k = %u; there are for 6, 32, 48, 64, 128, 256", k);
}

DirectionSet default_direction_set(uint32_t k, std::pmr::memory_resource& memory) {
  const auto directions = default_directions(k);
  return {{directions.begin(), directions.end(), &memory}, SOBB_TABLE_SPREAD};
}

sobb_table table_of_file(std::span<const Direction> directions) {
  const auto spread = default_directions(2 * static_cast<uint32_t>(directions.size()));
  const bool same = std::equal(directions.begin(), directions.end(), spread.begin(),
                               [](const Direction& a, const Direction& b) {
                                 return a.x == b.x && a.y == b.y && a.z == b.z;
                               });
  return same ? SOBB_TABLE_SPREAD : SOBB_TABLE_FITTED;
}

}  // namespace sobb
