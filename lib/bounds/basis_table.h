// SPDX-License-Identifier: Apache-2.0
// What the search for a basis needs of a direction table: one over |det| of every triple.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "bounds/direction_table.h"

namespace sobb {

// Triples flatter than this never bound anything: with two slabs of no width their area would be
// 0 whatever the third, and a nearly singular one could win (and its corners lie anywhere).
inline constexpr double kSmallestDeterminant = 0.02;

class BasisTable {
 public:
  BasisTable(const DirectionTable& directions, std::pmr::memory_resource& memory);

  uint32_t count() const { return count_; }
  // 1 / |det[n_i n_j n_l]|, infinite for a triple flatter than kSmallestDeterminant; a row of
  // kMaxDirections values over l.
  const float* inverse_determinants(uint32_t i, uint32_t j) const {
    return &inverse_[(i * kMaxDirections + j) * kMaxDirections];
  }
  // 1 / (1 - (n_i . n_j)^2), infinite for i = j; a row of kMaxDirections values over j.
  const float* inverse_sine_squares(uint32_t i) const { return &inverse_sine_[i * kMaxDirections]; }

 private:
  uint32_t count_;
  std::pmr::vector<float> inverse_;
  std::pmr::vector<float> inverse_sine_;
};

}  // namespace sobb
