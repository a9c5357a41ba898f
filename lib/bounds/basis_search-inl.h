// SPDX-License-Identifier: Apache-2.0
// Searches the basis of least area, for anything that has an area in every basis.
//
// The search is exact to the last bit. Rounded sums and products grow with their operands, so a
// bound computed like an area but from lesser operands is no more than that area as computed. Pairs
// whose bound is above the least area found are left out, and no better triple is lost with them.
//
// Volumes is what is searched. It offers, for directions a, b, c:
//   const float* extents()           a row whose least entry is the narrowest slab's direction
//   float square(b)                  the square of a width, for strategy k
//   void bound_pairs(a, bound)       fills a row over b: half the area of a basis (a, b, c) is at
//                                    least bound[b], or at least bound[c]
//   void bound_any_pairs(a, bound)   fills such a row where a basis may have its bound in the row
//                                    of only one of its directions
//   void bound_firsts(bound)         fills a row over a: at most any bound of bound_any_pairs(a)
//   Pair pair(a, b)                  a pair whose a was bounded last
//   Vec<Tag> Pair::operator()(c)     half the areas of the bases (a, b, c), (a, b, c + 1) and so
//                                    on, one per lane; infinite or NaN for flat triples
#if defined(SOBB_BOUNDS_BASIS_SEARCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_BOUNDS_BASIS_SEARCH_INL_H
#undef SOBB_BOUNDS_BASIS_SEARCH_INL_H
#else
#define SOBB_BOUNDS_BASIS_SEARCH_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/simd/mask_bits-inl.h"
#include "bounds/basis_table.h"
#include "bounds/bounds_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Rows are padded to multiples of eight (BasisTable::stride()), which is the most lanes that divide
// them.
using Tag = hn::CappedTag<float, 8>;

template <class Volumes>
class BasisSearch {
 public:
  BasisSearch(const BasisTable& table, Volumes& volumes) : table_(table), volumes_(volumes) {}

  TripleChoice choose(sobb_strategy strategy) {
    alignas(64) float bound[kMaxSearchedDirections];
    const uint32_t narrowest = least_of(volumes_.extents());
    volumes_.bound_pairs(narrowest, bound);
    if (strategy == SOBB_STRATEGY_K) {
      try_pair(narrowest, second(narrowest));
      return choice();
    }
    // The pair of the least bound first, so that few others are left.
    try_pair(narrowest, least_of(bound));
    try_pairs(narrowest, bound);
    if (strategy == SOBB_STRATEGY_K3) {
      alignas(64) float first_bound[kMaxSearchedDirections];
      volumes_.bound_firsts(first_bound);
      first_bound[narrowest] = INFINITY;
      for_each_within(first_bound, [&](uint32_t a) HWY_ATTR {
        volumes_.bound_any_pairs(a, bound);
        try_pairs(a, bound);
      });
    }
    return choice();
  }

 private:
  void try_pairs(uint32_t a, const float* bound) {
    for_each_within(bound, [&](uint32_t b) HWY_ATTR { try_pair(a, b); });
  }

  // Tries all third directions of a pair.
  void try_pair(uint32_t a, uint32_t b) {
    const Tag d;
    const auto half_areas = volumes_.pair(a, b);
    auto least = hn::Set(d, INFINITY);
    for (uint32_t c = 0; c < table_.stride(); c += hn::Lanes(d)) {
      const auto area = half_areas(c);
      least = hn::IfThenElse(hn::Lt(area, least), area, least);  // not where it is NaN
    }
    if (hn::AllFalse(d, hn::Le(least, hn::Set(d, half_area_)))) return;
    least = hn::MinOfLanes(d, least);
    for (uint32_t c = 0; c < table_.stride(); c += hn::Lanes(d)) {
      const uint32_t found = mask_bits(d, hn::Eq(half_areas(c), least));
      if (found != 0) return take(hn::GetLane(least), code_of(a, b, c + lowest(found)));
    }
  }

  void take(float half_area, uint32_t code) {
    if (half_area == half_area_ && code > code_) return;
    half_area_ = half_area;
    code_ = code;
  }

  // The second direction by strategy k: the one of least d_b^2 / (1 - cos^2), the parallelogram's
  // extent across slab a.
  uint32_t second(uint32_t a) const {
    alignas(64) float extent[kMaxSearchedDirections];
    const float* inverse_sine = table_.inverse_sine_squares(a);
    for (uint32_t b = 0; b < table_.count(); ++b) extent[b] = volumes_.square(b) * inverse_sine[b];
    extent[a] = INFINITY;
    return least_of(extent);
  }

  // The index of the least of a row's values; the lowest of equal ones.
  uint32_t least_of(const float* value) const {
    const Tag d;
    auto least = hn::Set(d, INFINITY);
    for (uint32_t i = 0; i < table_.count(); i += hn::Lanes(d)) {
      const auto used = hn::FirstN(d, table_.count() - i);
      least = hn::Min(hn::IfThenElse(used, hn::LoadU(d, value + i), least), least);
    }
    least = hn::MinOfLanes(d, least);
    for (uint32_t i = 0; i < table_.count(); i += hn::Lanes(d)) {
      const uint32_t found = mask_bits(d, hn::Eq(hn::LoadU(d, value + i), least));
      if (found != 0) return i + lowest(found);
    }
    return 0;
  }

  // Calls body(i) for every i whose bound is, when its turn comes, no more than the least area.
  template <class Body>
  void for_each_within(const float* bound, const Body& body) const {
    const Tag d;
    for (uint32_t group = 0; group < table_.stride(); group += hn::Lanes(d)) {
      const auto within = hn::Le(hn::Load(d, bound + group), hn::Set(d, half_area_));
      for (uint32_t left = mask_bits(d, within); left != 0; left &= left - 1) {
        const uint32_t i = group + lowest(left);
        if (bound[i] <= half_area_) body(i);
      }
    }
  }

  static uint32_t lowest(uint32_t bits) { return static_cast<uint32_t>(std::countr_zero(bits)); }

  // A triple as a number by which triples are compared: the lowest index first.
  static uint32_t code_of(uint32_t a, uint32_t b, uint32_t c) {
    const uint32_t low = std::min(std::min(a, b), c);
    const uint32_t high = std::max(std::max(a, b), c);
    return low << 16 | (a + b + c - low - high) << 8 | high;
  }

  TripleChoice choice() const {
    return {{code_ >> 16, code_ >> 8 & 0xFF, code_ & 0xFF}, 2 * half_area_};
  }

  const BasisTable& table_;
  Volumes& volumes_;
  // Finite, so that the search never takes a flat triple.
  float half_area_ = std::numeric_limits<float>::max();
  uint32_t code_ = code_of(0, 1, 2);
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
