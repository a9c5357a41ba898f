// SPDX-License-Identifier: Apache-2.0
// What the volumes of a method are fitted with: its directions and the searches over them.
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

// The directions of a method's k-DOP: none for the OBB.
std::span<const Direction> directions_of(const Method& method);

struct Tables {
  std::span<const Direction> directions;
  std::pmr::vector<DirectionTable> chunks;  // the same, kMaxDirections each
  BasisTable bases;                         // of volumes that are chosen; else empty
  const BoundsKernels& kernels;
  sobb_strategy strategy;
  float centre[3];
  float radius;
  float scale;  // of widths in searches, so that areas neither overflow nor vanish

  Tables(const Method& method, sobb_strategy strategy, const BoundsKernels& kernels,
         const MeshSummary& summary, std::pmr::memory_resource& memory);

  // A vertex as volumes see it, rounded once.
  RelativePoint relative(const float vertex[3]) const {
    return {static_cast<float>(static_cast<double>(vertex[0]) - centre[0]),
            static_cast<float>(static_cast<double>(vertex[1]) - centre[1]),
            static_cast<float>(static_cast<double>(vertex[2]) - centre[2])};
  }
};

}  // namespace sobb::study
