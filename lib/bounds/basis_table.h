// SPDX-License-Identifier: Apache-2.0
// The table by which bases are searched: one over |det| of every triple of directions.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "bounds/basis.h"

namespace sobb {

// Flatter triples are no bases: with two slabs of no width the area would be 0 whatever the third
// direction, so a nearly singular triple could win, and its corners could lie anywhere.
inline constexpr double kSmallestDeterminant = 0.02;

// A search takes more directions than a file does.
inline constexpr uint32_t kMaxSearchedDirections = 128;

// Holds 4 stride^3 bytes and little more: 128 KB for 32 directions, 8 MB for 128.
class BasisTable {
 public:
  BasisTable(std::span<const Direction> directions, std::pmr::memory_resource& memory);

  uint32_t count() const { return count_; }
  // The length of every row in floats: the count, rounded up to whole vectors. Rows are padded with
  // infinities; they are not aligned.
  uint32_t stride() const { return stride_; }

  // A row over l of 1 / |det[n_i n_j n_l]|, infinite for triples flatter than kSmallestDeterminant.
  // Every order of the three has the same bits.
  const float* inverse_determinants(uint32_t i, uint32_t j) const {
    return &inverse_[(size_t{i} * stride_ + j) * stride_];
  }
  // A row over j of the least entry of inverse_determinants(i, j): no basis with i and j has less.
  const float* least_inverses(uint32_t i) const { return &least_[size_t{i} * stride_]; }
  float least_inverse() const {
    return least_of_all_;
  }  // 1 within rounding where the axes are in the table
  // A row over j of 1 / (1 - (n_i . n_j)^2), infinite where no basis has i and j.
  const float* inverse_sine_squares(uint32_t i) const {
    return &inverse_sine_[size_t{i} * stride_];
  }

 private:
  void set_triple(uint32_t i, uint32_t j, uint32_t l, float inverse);

  uint32_t count_;
  uint32_t stride_;
  float least_of_all_;
  std::pmr::vector<float> inverse_;
  std::pmr::vector<float> least_;
  std::pmr::vector<float> inverse_sine_;
};

}  // namespace sobb
