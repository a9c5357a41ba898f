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
      return choice();
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
    return choice();
  }

 private:
  using Tag = hn::CappedTag<float, 8>;
  using Vector = hn::Vec<Tag>;

  // The index of the least of a row's values; of equal ones, the lowest.
  uint32_t least_of(const float* value) const {
    const Tag d;
    auto least = hn::Set(d, INFINITY);
    for (uint32_t i = 0; i < table_.count(); i += hn::Lanes(d)) {
      least = hn::Min(hn::IfThenElse(used(i), hn::LoadU(d, value + i), least), least);
    }
    least = hn::MinOfLanes(d, least);
    for (uint32_t i = 0; i < table_.count(); i += hn::Lanes(d)) {
      const uint64_t found = bits(hn::Eq(hn::LoadU(d, value + i), least));
      if (found != 0) return i + lowest(found);
    }
    return 0;
  }

  hn::Mask<Tag> used(uint32_t group) const { return hn::FirstN(Tag(), table_.count() - group); }

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
      const auto least = hn::LoadU(d, inverse + b);
      const auto bound = hn::Mul(half_faces(first, second, second), least);
      const auto possible = hn::And(hn::Ge(width, first), hn::Lt(least, hn::Set(d, INFINITY)));
      hn::Store(second, d, clamped_ + b);
      hn::Store(hn::IfThenElse(possible, bound, hn::Set(d, INFINITY)), d, bound_ + b);
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
        const uint32_t b = group + lowest(left);
        if (bound_[b] <= half_area_) try_pair(a, b);
      }
    }
  }

  // Tries all thirds of a pair at once. Flat triples have an infinite reciprocal: their area is
  // infinite, or NaN where the slabs have no width, and never less than another.
  void try_pair(uint32_t a, uint32_t b) {
    const Tag d;
    auto least = hn::Set(d, INFINITY);
    const auto first = hn::Set(d, width_[a]);
    const auto second = hn::Set(d, clamped_[b]);
    const float* inverse = table_.inverse_determinants(a, b);
    for (uint32_t c = 0; c < table_.stride(); c += hn::Lanes(d)) {
      const auto area = thirds(first, second, inverse, c);
      least = hn::IfThenElse(hn::Lt(area, least), area, least);
    }
    if (hn::AllFalse(d, hn::Le(least, hn::Set(d, half_area_)))) return;
    least = hn::MinOfLanes(d, least);
    for (uint32_t c = 0; c < table_.stride(); c += hn::Lanes(d)) {
      const uint64_t found = bits(hn::Eq(thirds(first, second, inverse, c), least));
      if (found != 0) return take(hn::GetLane(least), code_of(a, b, c + lowest(found)));
    }
  }

  // Half the areas of (a; b, c) for the thirds from c on; `inverse` is the pair's row.
  Vector thirds(Vector first, Vector second, const float* inverse, uint32_t c) const {
    const Tag d;
    return hn::Mul(half_faces(first, second, hn::Load(d, clamped_ + c)), hn::LoadU(d, inverse + c));
  }

  void take(float half_area, uint32_t code) {
    if (half_area == half_area_ && code > code_) return;
    half_area_ = half_area;
    code_ = code;
  }

  // A triple as a number: compared, its lowest index counts first.
  static uint32_t code_of(uint32_t a, uint32_t b, uint32_t c) {
    const uint32_t low = std::min(std::min(a, b), c);
    const uint32_t high = std::max(std::max(a, b), c);
    return low << 16 | (a + b + c - low - high) << 8 | high;
  }

  TripleChoice choice() const {
    return {{code_ >> 16, code_ >> 8 & 0xFF, code_ & 0xFF}, 2 * half_area_};
  }

  static uint64_t bits(hn::Mask<Tag> mask) {
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(Tag(), mask, bytes);
    return bytes[0];
  }

  static uint32_t lowest(uint64_t bits) {
    return static_cast<uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
  }

  const BasisTable& table_;
  const float* width_;
  uint32_t narrowest_;
  // Finite, so that a flat triple is never taken.
  float half_area_ = std::numeric_limits<float>::max();
  uint32_t code_ = code_of(0, 1, 2);
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
