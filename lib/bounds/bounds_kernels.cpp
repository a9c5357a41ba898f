// SPDX-License-Identifier: Apache-2.0
#include "bounds/bounds_kernels.h"

#include <algorithm>
#include <cmath>

#include "base/instruction_sets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bounds/bounds_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bounds/gram-inl.h"
#include "bounds/one_volume-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

void fit(const DirectionTable& directions, const RelativePoint* points, uint64_t count,
         Kdop& kdop) {
  const Tag d;
  RelativePoint largest{0, 0, 0};
  for (uint64_t i = 0; i < count; ++i) {
    largest = {std::max(largest.x, std::fabs(points[i].x)),
               std::max(largest.y, std::fabs(points[i].y)),
               std::max(largest.z, std::fabs(points[i].z))};
  }
  uint32_t k = 0;
  for (; k < directions.count; k += static_cast<uint32_t>(hn::Lanes(d))) {
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
  std::fill(kdop.lower + k, kdop.lower + kMaxDirections, 0.0F);
  std::fill(kdop.upper + k, kdop.upper + kMaxDirections, 0.0F);
}

}  // namespace

const BoundsKernels& target_bounds_kernels() {
  static constexpr BoundsKernels kKernels = {fit, widths, add_to_gram, choose_one, choose};
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
  const auto [low, high] = std::minmax(gram.sum[i][j], gram.sum[j][l]);
  const float middle = std::min(high, gram.sum[i][l]);
  const float sum = std::min(low, middle) + std::max(low, middle) + std::max(high, gram.sum[i][l]);
  return 2 * (sum * table.inverse_determinants(i, j)[l]);
}

TripleChoice or_frame(const BasisTable& table, const float* width, const TripleChoice& choice) {
  const float faces = width[0] * width[1] + width[1] * width[2] + width[2] * width[0];
  const float area = 2 * (faces * table.inverse_determinants(0, 1)[2]);
  return area < choice.area ? TripleChoice{{0, 1, 2}, area} : choice;
}

const BoundsKernels& bounds_kernels(sobb_isa isa) {
  return SOBB_DISPATCH(isa, target_bounds_kernels)();
}

}  // namespace sobb
#endif
