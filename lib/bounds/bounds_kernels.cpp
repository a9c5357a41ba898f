// SPDX-License-Identifier: Apache-2.0
#include "bounds/bounds_kernels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/highway_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bounds/bounds_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bounds/choose_one-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 8>;
using Indices = hn::RebindToSigned<Floats>;

void fit(const DirectionTable& directions, const RelativePoint* points, uint64_t count,
         Kdop& kdop) {
  const Floats d;
  RelativePoint largest{0, 0, 0};
  for (uint64_t i = 0; i < count; ++i) {
    largest = {std::max(largest.x, std::fabs(points[i].x)),
               std::max(largest.y, std::fabs(points[i].y)),
               std::max(largest.z, std::fabs(points[i].z))};
  }
  for (uint32_t k = 0; k < kMaxDirections; k += hn::Lanes(d)) {
    const auto nx = hn::Load(d, directions.x + k);
    const auto ny = hn::Load(d, directions.y + k);
    const auto nz = hn::Load(d, directions.z + k);
    auto lower = hn::Set(d, INFINITY);
    auto upper = hn::Set(d, -INFINITY);
    for (uint64_t i = 0; i < count; ++i) {
      // n . p, without fused multiply-add: the file's bytes rest on it.
      const auto x = hn::Mul(nx, hn::Set(d, points[i].x));
      const auto y = hn::Mul(ny, hn::Set(d, points[i].y));
      const auto z = hn::Mul(nz, hn::Set(d, points[i].z));
      const auto along = hn::Add(hn::Add(x, y), z);
      lower = hn::Min(lower, along);
      upper = hn::Max(upper, along);
    }
    const auto reach = hn::Add(hn::Add(hn::Mul(hn::Abs(nx), hn::Set(d, largest.x)),
                                       hn::Mul(hn::Abs(ny), hn::Set(d, largest.y))),
                               hn::Mul(hn::Abs(nz), hn::Set(d, largest.z)));
    // The second term covers products that underflow.
    const auto error = hn::Add(hn::Mul(reach, hn::Set(d, 6 * 0x1p-24F)), hn::Set(d, 0x1p-140F));
    const auto unused =
        hn::Eq(hn::Add(hn::Add(hn::Abs(nx), hn::Abs(ny)), hn::Abs(nz)), hn::Zero(d));
    hn::Store(hn::IfThenZeroElse(unused, hn::Sub(lower, error)), d, kdop.lower + k);
    hn::Store(hn::IfThenZeroElse(unused, hn::Add(upper, error)), d, kdop.upper + k);
  }
}

void add_to_gram(const Kdop& kdop, float scale, float weight, Gram& gram) {
  const Floats d;
  alignas(64) float width[kMaxDirections];
  for (uint32_t k = 0; k < kMaxDirections; k += hn::Lanes(d)) {
    const auto extent = hn::Sub(hn::Load(d, kdop.upper + k), hn::Load(d, kdop.lower + k));
    hn::Store(hn::Mul(extent, hn::Set(d, scale)), d, width + k);
  }
  for (uint32_t i = 0; i < kMaxDirections; ++i) {
    const auto factor = hn::Set(d, weight * width[i]);
    for (uint32_t k = 0; k < kMaxDirections; k += hn::Lanes(d)) {
      const auto term = hn::Mul(factor, hn::Load(d, width + k));
      hn::Store(hn::Add(hn::Load(d, gram.sum[i] + k), term), d, gram.sum[i] + k);
    }
  }
}

// The least area and its third direction so far, lane by lane.
class Least {
 public:
  Least() : area_(hn::Set(Floats(), INFINITY)), code_(hn::Zero(Indices())) {}

  // Tries (i, j, l) for all l at once: (G_ij + G_jl + G_li) / |det|. Flat triples have an infinite
  // reciprocal: their area is infinite, or NaN where the sum is 0, and never less than another.
  void try_thirds(const BasisTable& table, const Gram& gram, uint32_t i, uint32_t j) {
    const Floats d;
    const float* inverse = table.inverse_determinants(i, j);
    const auto pair = hn::Set(d, gram.sum[i][j]);
    for (uint32_t l = 0; l < table.count(); l += hn::Lanes(d)) {
      const auto sum =
          hn::Add(hn::Add(pair, hn::Load(d, gram.sum[j] + l)), hn::Load(d, gram.sum[i] + l));
      const auto area = hn::Mul(sum, hn::LoadU(d, inverse + l));
      const auto less = hn::Lt(area, area_);
      area_ = hn::IfThenElse(less, area, area_);
      const auto code = hn::Add(hn::Set(Indices(), static_cast<int32_t>(code_of(i, j) + l)),
                                hn::Iota(Indices(), 0));
      code_ = hn::IfThenElse(hn::RebindMask(Indices(), less), code, code_);
    }
  }

  // The least over the lanes; the codes of equal areas compare as their indices do.
  BasisChoice choice() const {
    const Floats d;
    alignas(64) float area[hn::MaxLanes(d)];
    alignas(64) int32_t code[hn::MaxLanes(d)];
    hn::Store(area_, d, area);
    hn::Store(code_, Indices(), code);
    size_t best = 0;
    for (size_t lane = 1; lane < hn::Lanes(d); ++lane) {
      if (area[lane] < area[best] || (area[lane] == area[best] && code[lane] < code[best])) {
        best = lane;
      }
    }
    uint32_t index[3] = {static_cast<uint32_t>(code[best]) >> 10,
                         static_cast<uint32_t>(code[best]) >> 5 & 31,
                         static_cast<uint32_t>(code[best]) & 31};
    std::sort(index, index + 3);
    return {make_basis(index[0], index[1], index[2]), 2 * area[best]};
  }

 private:
  static uint32_t code_of(uint32_t i, uint32_t j) { return i << 10 | j << 5; }

  hn::Vec<Floats> area_;
  hn::Vec<Indices> code_;
};

// The direction of the narrowest slab, by the sum of squared widths.
uint32_t narrowest(const BasisTable& table, const Gram& gram) {
  uint32_t best = 0;
  for (uint32_t i = 1; i < table.count(); ++i) {
    if (gram.sum[i][i] < gram.sum[best][best]) best = i;
  }
  return best;
}

// The second direction of strategy k: least d_j^2 / (1 - cos^2), the parallelogram's extent across
// slab i.
uint32_t best_second(const BasisTable& table, const Gram& gram, uint32_t i) {
  const float* inverse_sine = table.inverse_sine_squares(i);
  uint32_t best = i == 0 ? 1 : 0;
  float least = INFINITY;
  for (uint32_t j = 0; j < table.count(); ++j) {
    const float extent = j == i ? INFINITY : gram.sum[j][j] * inverse_sine[j];
    if (extent < least) {
      least = extent;
      best = j;
    }
  }
  return best;
}

BasisChoice choose(const BasisTable& table, const Gram& gram, sobb_strategy strategy) {
  Least least;
  const uint32_t count = table.count();
  if (strategy == SOBB_STRATEGY_K3) {
    for (uint32_t i = 0; i + 2 < count; ++i) {
      for (uint32_t j = i + 1; j + 1 < count; ++j) least.try_thirds(table, gram, i, j);
    }
  } else {
    const uint32_t i = narrowest(table, gram);
    if (strategy == SOBB_STRATEGY_K) {
      least.try_thirds(table, gram, i, best_second(table, gram, i));
    } else {
      for (uint32_t j = 0; j < count; ++j) {
        if (j != i) least.try_thirds(table, gram, i, j);
      }
    }
  }
  return least.choice();
}

}  // namespace

const BoundsKernels& target_bounds_kernels() {
  static constexpr BoundsKernels kKernels = {fit, add_to_gram, choose_one, choose};
  return kKernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sobb {

float area_in_basis(const BasisTable& table, const Gram& gram, uint16_t basis) {
  const uint32_t i = basis_direction(basis, 0);
  const uint32_t j = basis_direction(basis, 1);
  const uint32_t l = basis_direction(basis, 2);
  return 2 *
         ((gram.sum[i][j] + gram.sum[j][l] + gram.sum[i][l]) * table.inverse_determinants(i, j)[l]);
}

const BoundsKernels& bounds_kernels(sobb_isa isa) {
  return isa == SOBB_ISA_AVX2 ? N_AVX2::target_bounds_kernels() : N_SSE4::target_bounds_kernels();
}

}  // namespace sobb
#endif
