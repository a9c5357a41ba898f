// SPDX-License-Identifier: Apache-2.0
// Chooses the basis that several volumes share, by their Gram matrix.
//
// The area is computed from the three entries in rising order,
//   A(a, b, c) = 2 ((least + middle) + greatest) / |det[n_a n_b n_c]|  of  G_ab, G_bc, G_ca
// which has the same bits for every order of the directions. It does not rise when an entry is
// replaced by a lesser one: by another of the three, or by the least entry of a column.
#if defined(SOBB_BOUNDS_GRAM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_BOUNDS_GRAM_INL_H
#undef SOBB_BOUNDS_GRAM_INL_H
#else
#define SOBB_BOUNDS_GRAM_INL_H
#endif

#include "bounds/basis_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

void widths(const Kdop& kdop, float scale, float width[kMaxDirections]) {
  const Tag d;
  for (uint32_t k = 0; k < kMaxDirections; k += hn::Lanes(d)) {
    const auto extent = hn::Sub(hn::Load(d, kdop.upper + k), hn::Load(d, kdop.lower + k));
    hn::StoreU(hn::Mul(extent, hn::Set(d, scale)), d, width + k);
  }
}

void add_to_gram(const Kdop& kdop, float scale, float weight, Gram& gram) {
  const Tag d;
  // The root of the weight is in both factors, so the matrix is symmetric to the last bit.
  alignas(64) float width[kMaxDirections];
  widths(kdop, scale * std::sqrt(weight), width);
  for (uint32_t i = 0; i < kMaxDirections; ++i) {
    const auto across = hn::Set(d, width[i]);
    for (uint32_t k = 0; k < kMaxDirections; k += hn::Lanes(d)) {
      const auto term = hn::Mul(across, hn::Load(d, width + k));
      hn::Store(hn::Add(hn::Load(d, gram.sum[i] + k), term), d, gram.sum[i] + k);
    }
  }
}

class GramVolumes {
 public:
  GramVolumes(const BasisTable& table, const Gram& gram) : table_(table), gram_(gram) {
    const Tag d;
    for (uint32_t k = 0; k < table.stride(); k += hn::Lanes(d)) {
      auto least = hn::Set(d, INFINITY);
      for (uint32_t i = 0; i < table.count(); ++i) {
        least = hn::Min(least, hn::Load(d, gram.sum[i] + k));
      }
      hn::Store(least, d, least_ + k);
    }
    for (uint32_t i = 0; i < table.count(); ++i) diagonal_[i] = gram.sum[i][i];
  }

  const float* extents() const { return diagonal_; }
  float square(uint32_t b) const { return diagonal_[b]; }

  // The bound holds for the one of the two others whose entry beside a is lesser.
  void bound_pairs(uint32_t a, float* bound) const {
    const Tag d;
    for (uint32_t b = 0; b < table_.stride(); b += hn::Lanes(d)) {
      const auto pair = hn::Load(d, gram_.sum[a] + b);
      store_bound(a, b, sum_of(pair, pair, hn::Load(d, least_ + b)), bound);
    }
  }

  // The bound holds for the pair whose entry is the least of the three. The rows of lower
  // directions have the pairs with these.
  void bound_any_pairs(uint32_t a, float* bound) const {
    const Tag d;
    for (uint32_t b = 0; b < table_.stride(); b += hn::Lanes(d)) {
      const auto pair = hn::Load(d, gram_.sum[a] + b);
      store_bound(a, b, sum_of(pair, pair, pair), bound);
    }
    std::fill(bound, bound + a, INFINITY);
  }

  // The bound holds since no entry is less than the least of its column.
  void bound_firsts(float* bound) const {
    const Tag d;
    const auto inverse = hn::Set(d, table_.least_inverse());
    for (uint32_t a = 0; a < table_.stride(); a += hn::Lanes(d)) {
      const auto least = hn::Load(d, least_ + a);
      hn::Store(hn::Mul(sum_of(least, least, least), inverse), d, bound + a);
    }
    std::fill(bound + table_.count(), bound + table_.stride(), INFINITY);
  }

  class Pair {
   public:
    Pair(const GramVolumes& volumes, uint32_t a, uint32_t b)
        : both_(hn::Set(Tag(), volumes.gram_.sum[a][b])),
          of_a_(volumes.gram_.sum[a]),
          of_b_(volumes.gram_.sum[b]),
          inverse_(volumes.table_.inverse_determinants(a, b)) {}

    hn::Vec<Tag> operator()(uint32_t c) const {
      const Tag d;
      return hn::Mul(sum_of(both_, hn::Load(d, of_a_ + c), hn::Load(d, of_b_ + c)),
                     hn::LoadU(d, inverse_ + c));
    }

   private:
    hn::Vec<Tag> both_;
    const float* of_a_;
    const float* of_b_;
    const float* inverse_;
  };

  Pair pair(uint32_t a, uint32_t b) const { return {*this, a, b}; }

 private:
  // Stores a bound, infinite where no basis has the pair.
  void store_bound(uint32_t a, uint32_t b, hn::Vec<Tag> sum, float* bound) const {
    const Tag d;
    const auto infinity = hn::Set(d, INFINITY);
    const auto inverse = hn::LoadU(d, table_.least_inverses(a) + b);
    hn::Store(hn::IfThenElse(hn::Lt(inverse, infinity), hn::Mul(sum, inverse), infinity), d,
              bound + b);
  }

  // Adds the terms in rising order.
  static hn::Vec<Tag> sum_of(hn::Vec<Tag> x, hn::Vec<Tag> y, hn::Vec<Tag> z) {
    const auto low = hn::Min(x, y);
    const auto high = hn::Max(x, y);
    const auto middle = hn::Min(high, z);
    return hn::Add(hn::Add(hn::Min(low, middle), hn::Max(low, middle)), hn::Max(high, z));
  }

  const BasisTable& table_;
  const Gram& gram_;
  alignas(64) float least_[kMaxDirections];
  alignas(64) float diagonal_[kMaxDirections];
};

BasisChoice choose(const BasisTable& table, const Gram& gram, sobb_strategy strategy) {
  GramVolumes volumes(table, gram);
  const TripleChoice choice = BasisSearch<GramVolumes>(table, volumes).choose(strategy);
  return {make_basis(choice.direction[0], choice.direction[1], choice.direction[2]), choice.area};
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
