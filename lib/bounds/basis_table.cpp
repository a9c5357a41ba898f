// SPDX-License-Identifier: Apache-2.0
#include "bounds/basis_table.h"

#include <cmath>
#include <limits>

#include "bounds/area.h"

namespace sobb {

BasisTable::BasisTable(const DirectionTable& table, std::pmr::memory_resource& memory)
    : count_(table.count),
      inverse_(size_t{kMaxDirections} * kMaxDirections * kMaxDirections,
               std::numeric_limits<float>::infinity(), &memory),
      inverse_sine_(size_t{kMaxDirections} * kMaxDirections, std::numeric_limits<float>::infinity(),
                    &memory) {
  const auto direction = [&](uint32_t k) { return Direction{table.x[k], table.y[k], table.z[k]}; };
  for (uint32_t i = 0; i < count_; ++i) {
    for (uint32_t j = 0; j < count_; ++j) {
      if (i == j) continue;
      const double cosine = dot(direction(i), direction(j));
      inverse_sine_[i * kMaxDirections + j] = static_cast<float>(1 / (1 - cosine * cosine));
      for (uint32_t l = 0; l < count_; ++l) {
        const double det = std::fabs(determinant(direction(i), direction(j), direction(l)));
        if (det < kSmallestDeterminant) continue;
        inverse_[(i * kMaxDirections + j) * kMaxDirections + l] = static_cast<float>(1 / det);
      }
    }
  }
}

}  // namespace sobb
