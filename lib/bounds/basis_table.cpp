// SPDX-License-Identifier: Apache-2.0
#include "bounds/basis_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "bounds/area.h"

namespace sobb {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

// Rounds up to vectors of eight, whatever the target's have: all targets read the same rows.
uint32_t rounded_up(size_t count) {
  if (count > kMaxSearchedDirections) {
    fail(SOBB_ERROR_INVALID_ARGUMENT, "a search for bases of %zu directions; it takes up to %u",
         count, kMaxSearchedDirections);
  }
  return static_cast<uint32_t>((count + 7) / 8 * 8);
}

}  // namespace

BasisTable::BasisTable(std::span<const Direction> directions, std::pmr::memory_resource& memory)
    : count_(static_cast<uint32_t>(directions.size())),
      stride_(rounded_up(directions.size())),
      least_of_all_(kInfinite),
      inverse_(size_t{stride_} * stride_ * stride_, kInfinite, &memory),
      least_(size_t{stride_} * stride_, kInfinite, &memory),
      inverse_sine_(size_t{stride_} * stride_, kInfinite, &memory) {
  for (uint32_t i = 0; i < count_; ++i) {
    for (uint32_t j = i + 1; j < count_; ++j) {
      for (uint32_t l = j + 1; l < count_; ++l) {
        const double det = std::fabs(determinant(directions[i], directions[j], directions[l]));
        if (det >= kSmallestDeterminant) set_triple(i, j, l, static_cast<float>(1 / det));
      }
    }
  }
  for (uint32_t i = 0; i < count_; ++i) {
    for (uint32_t j = 0; j < count_; ++j) {
      const float* row = inverse_determinants(i, j);
      const float least = *std::min_element(row, row + stride_);
      least_[size_t{i} * stride_ + j] = least;
      least_of_all_ = std::min(least_of_all_, least);
      if (least == kInfinite) continue;
      const double cosine = dot(directions[i], directions[j]);
      inverse_sine_[size_t{i} * stride_ + j] = static_cast<float>(1 / (1 - cosine * cosine));
    }
  }
}

void BasisTable::set_triple(uint32_t i, uint32_t j, uint32_t l, float inverse) {
  const uint32_t order[6][3] = {{i, j, l}, {i, l, j}, {j, i, l}, {j, l, i}, {l, i, j}, {l, j, i}};
  for (const auto& at : order) {
    inverse_[(size_t{at[0]} * stride_ + at[1]) * stride_ + at[2]] = inverse;
  }
}

}  // namespace sobb
