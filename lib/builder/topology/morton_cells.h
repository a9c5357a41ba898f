// SPDX-License-Identifier: Apache-2.0
// Sorts triangles into the cells of a grid, with the cells in Morton order.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/scheduler.h"
#include "builder/boxes/frame.h"
#include "builder/mesh.h"

namespace sobb {

// A grid has at most 2^kMostCellLevels cells.
inline constexpr uint32_t kMostCellLevels = 15;

// The triangles of cell i are those from begin[i] to begin[i + 1] - 1. A power of two of cells,
// from a multiple of it on, is a box of the grid.
struct MortonCells {
  std::pmr::vector<uint64_t> begin;  // one more than there are cells

  uint64_t count() const { return begin.size() - 1; }
  uint64_t triangle_count() const { return begin.back(); }
  // Tells whether one cell has all triangles.
  bool is_one() const;
};

// Sorts triangles by the centres of their boxes. Those of one cell stay in the order that they
// have. The result is the same for any number of threads.
MortonCells sort_into_cells(const Mesh& mesh, const Frame& frame, std::span<uint32_t> triangles,
                            const Scheduler& scheduler, std::pmr::memory_resource& memory);

}  // namespace sobb
