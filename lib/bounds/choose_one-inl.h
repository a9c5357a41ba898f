// SPDX-License-Identifier: Apache-2.0
// The basis of least area of one volume, from its widths along every direction. Included once for
// each Highway target.
//
// The area is computed from the narrowest slab a and the two others, b and c:
//   A(a; b, c) = 2 (d_b d_c + d_a (d_b + d_c)) / |det[n_a n_b n_c]|
// the same bits for either order of b and c (and of a and b, where they are equally wide). Rounded
// sums and products grow with their operands, so
//   B(a; b) = (d_b d_b + d_a (d_b + d_b)) min_c 1 / |det[n_a n_b n_c]|
// is no more than half the area, as computed, of any basis whose narrowest slabs are a and b, in
// this order. Pairs bounded above the least area found are left out: the search is exact, to the
// last bit.
#if defined(SOBB_BOUNDS_CHOOSE_ONE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_BOUNDS_CHOOSE_ONE_INL_H
#undef SOBB_BOUNDS_CHOOSE_ONE_INL_H
#else
#define SOBB_BOUNDS_CHOOSE_ONE_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bounds/basis_table.h"
#include "bounds/bounds_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

class OneVolume {
 public:
  OneVolume(const BasisTable& table, const float* width)
      : table_(table), width_(width), narrowest_(least_of(width)) {}

  TripleChoice choose(sobb_strategy strategy) {
    bound_pairs(narrowest_);
    if (strategy == SOBB_STRATEGY_K) {
      try_pair(narrowest_, second());
      return choice_;
    }
    // The pair of the least bound first, so that few others are left.
    try_pair(narrowest_, least_of(bound_));
    try_pairs(narrowest_);
    if (strategy == SOBB_STRATEGY_K3) {
      for (uint32_t a = 0; a < table_.count(); ++a) {
        const float least = width_[a] * width_[a] + width_[a] * (width_[a] + width_[a]);
        if (a == narrowest_ || least * table_.least_inverse() > half_area_) continue;
        bound_pairs(a);
        try_pairs(a);
      }
    }
    return choice_;
  }

 private:
  using Tag = hn::CappedTag<float, 8>;
  using Vector = hn::Vec<Tag>;

  // The index of the least value; of equal ones, the lowest.
  uint32_t least_of(const float* value) const {
    return static_cast<uint32_t>(std::min_element(value, value + table_.count()) - value);
  }

  // Half the areas of (a; b, c) times |det|, given a's width, b's and c's. No fused multiply-add:
  // the file's bytes rest on it.
  static Vector half_faces(Vector a, Vector b, Vector c) {
    return hn::Add(hn::Mul(b, c), hn::Mul(a, hn::Add(b, c)));
  }

  // B(a; b) for every b no narrower than a, infinite for the others. Of those, what counts as their
  // width from here on is a's: with a third of that pair they seem no smaller than they are.
  void bound_pairs(uint32_t a) {
    const Tag d;
    const auto first = hn::Set(d, width_[a]);
    const float* inverse = table_.least_inverses(a);
    for (uint32_t b = 0; b < table_.stride(); b += hn::Lanes(d)) {
      const auto width = hn::LoadU(d, width_ + b);
      const auto second = hn::Max(width, first);
      const auto bound = hn::Mul(half_faces(first, second, second), hn::LoadU(d, inverse + b));
      hn::Store(second, d, clamped_ + b);
      hn::Store(hn::IfThenElse(hn::Ge(width, first), bound, hn::Set(d, INFINITY)), d, bound_ + b);
    }
  }

  // The second direction of strategy k: least d_b^2 / (1 - cos^2), the parallelogram's extent
  // across slab a.
  uint32_t second() {
    const float* inverse_sine = table_.inverse_sine_squares(narrowest_);
    for (uint32_t b = 0; b < table_.count(); ++b) {
      bound_[b] = b == narrowest_ ? INFINITY : width_[b] * width_[b] * inverse_sine[b];
    }
    return least_of(bound_);
  }

  void try_pairs(uint32_t a) {
    const Tag d;
    for (uint32_t group = 0; group < table_.stride(); group += hn::Lanes(d)) {
      const auto bound = hn::Load(d, bound_ + group);
      for (uint64_t left = bits(hn::Le(bound, hn::Set(d, half_area_))); left != 0;
           left &= left - 1) {
        const uint32_t b = group + static_cast<uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero64(left));
        if (bound_[b] <= half_area_) try_pair(a, b);
      }
    }
  }

  // Tries all thirds of a pair at once. Flat triples have an infinite reciprocal: their area is
  // infinite, or NaN where the slabs have no width, and never taken.
  void try_pair(uint32_t a, uint32_t b) {
    const Tag d;
    const auto first = hn::Set(d, width_[a]);
    const auto second = hn::Set(d, clamped_[b]);
    const float* inverse = table_.inverse_determinants(a, b);
    for (uint32_t c = 0; c < table_.stride(); c += hn::Lanes(d)) {
      const auto faces = half_faces(first, second, hn::Load(d, clamped_ + c));
      const auto area = hn::Mul(faces, hn::LoadU(d, inverse + c));
      const auto taken = hn::Le(area, hn::Set(d, half_area_));
      if (HWY_UNLIKELY(!hn::AllFalse(d, taken))) take(area, bits(taken), a, b, c);
    }
  }

  HWY_NOINLINE void take(Vector areas, uint64_t lanes, uint32_t a, uint32_t b, uint32_t first_c) {
    const Tag d;
    alignas(64) float area[hn::MaxLanes(d)];
    hn::Store(areas, d, area);
    for (; lanes != 0; lanes &= lanes - 1) {
      const size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero64(lanes);
      uint32_t index[3] = {a, b, first_c + static_cast<uint32_t>(lane)};
      std::sort(index, index + 3);
      const bool before =
          std::lexicographical_compare(index, index + 3, choice_.direction, choice_.direction + 3);
      if (area[lane] < half_area_ || (area[lane] == half_area_ && before)) {
        half_area_ = area[lane];
        choice_.area = 2 * half_area_;
        std::copy(index, index + 3, choice_.direction);
      }
    }
  }

  static uint64_t bits(hn::Mask<Tag> mask) {
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(Tag(), mask, bytes);
    return bytes[0];
  }

  const BasisTable& table_;
  const float* width_;
  uint32_t narrowest_;
  // Finite, so that a flat triple is never taken.
  float half_area_ = std::numeric_limits<float>::max();
  TripleChoice choice_;
  alignas(64) float clamped_[kMaxSearchedDirections];
  alignas(64) float bound_[kMaxSearchedDirections];
};

TripleChoice choose_one(const BasisTable& table, const float* width, sobb_strategy strategy) {
  return OneVolume(table, width).choose(strategy);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
