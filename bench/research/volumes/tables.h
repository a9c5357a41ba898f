// SPDX-License-Identifier: Apache-2.0
// Tables are what the volumes of a method are fitted with: its directions and the searches over
// them.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "bounds/basis_table.h"
#include "bounds/bounds_kernels.h"
#include "bounds/directions/direction_table.h"
#include "builder/mesh.h"
#include "volumes/method.h"

namespace sobb::study {

// The directions of a method's k-DOP. The OBB has none.
std::span<const Direction> directions_of(const Method& method);

struct Tables {
  std::span<const Direction> directions;
  std::pmr::vector<DirectionTable> chunks;  // the same directions, kMaxDirections per table
  BasisTable bases;                         // empty where no strategy chooses
  const BoundsKernels& kernels;
  sobb_strategy strategy;
  float centre[3];
  float radius;
  float scale;  // scales widths in searches, so that areas neither overflow nor vanish

  Tables(const Method& method, sobb_strategy strategy, const BoundsKernels& kernels,
         const MeshSummary& summary, std::pmr::memory_resource& memory);

  // A vertex relative to the centre, rounded once.
  RelativePoint relative(const float vertex[3]) const {
    return {static_cast<float>(static_cast<double>(vertex[0]) - centre[0]),
            static_cast<float>(static_cast<double>(vertex[1]) - centre[1]),
            static_cast<float>(static_cast<double>(vertex[2]) - centre[2])};
  }
};

}  // namespace sobb::study
