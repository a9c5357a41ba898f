// SPDX-License-Identifier: Apache-2.0
// Chooses the basis of one volume by its widths along every direction.
//
// The area is computed from the narrowest slab a and the two others, b and c:
//   A(a; b, c) = 2 (d_b d_c + d_a (d_b + d_c)) / |det[n_a n_b n_c]|
// which has the same bits for either order of b and c (and of a and b, where they are equally
// wide). If b is the narrower of these two, half of the area is at least
//   B(a; b) = (d_b d_b + d_a (d_b + d_b)) min_c 1 / |det[n_a n_b n_c]|
#if defined(SOBB_BOUNDS_ONE_VOLUME_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_BOUNDS_ONE_VOLUME_INL_H
#undef SOBB_BOUNDS_ONE_VOLUME_INL_H
#else
#define SOBB_BOUNDS_ONE_VOLUME_INL_H
#endif

#include "bounds/basis_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

class OneVolume {
 public:
  OneVolume(const BasisTable& table, const float* width) : table_(table), width_(width) {}

  const float* extents() const { return width_; }
  float square(uint32_t b) const { return width_[b] * width_[b]; }

  // Bounds the pairs of a with directions no narrower than a; the others have such pairs in rows of
  // their own. Here the others count as wide as a, so that as third directions they never make an
  // area seem smaller than it is.
  void bound_pairs(uint32_t a, float* bound) {
    const Tag d;
    const auto infinity = hn::Set(d, INFINITY);
    const auto first = hn::Set(d, width_[a]);
    const float* inverse = table_.least_inverses(a);
    for (uint32_t b = 0; b < table_.stride(); b += hn::Lanes(d)) {
      const auto width = hn::LoadU(d, width_ + b);
      const auto second = hn::Max(width, first);
      const auto least = hn::LoadU(d, inverse + b);
      const auto possible = hn::And(hn::Ge(width, first), hn::Lt(least, infinity));
      const auto half_area = hn::Mul(half_faces(first, second, second), least);
      hn::Store(second, d, clamped_ + b);
      hn::Store(hn::IfThenElse(possible, half_area, infinity), d, bound + b);
    }
  }

  void bound_any_pairs(uint32_t a, float* bound) { bound_pairs(a, bound); }

  // The bound holds since both others are at least as wide as a.
  void bound_firsts(float* bound) const {
    const Tag d;
    const auto least = hn::Set(d, table_.least_inverse());
    for (uint32_t a = 0; a < table_.stride(); a += hn::Lanes(d)) {
      const auto width = hn::LoadU(d, width_ + a);
      hn::Store(hn::Mul(half_faces(width, width, width), least), d, bound + a);
    }
    std::fill(bound + table_.count(), bound + table_.stride(), INFINITY);
  }

  class Pair {
   public:
    Pair(const OneVolume& volume, uint32_t a, uint32_t b)
        : first_(hn::Set(Tag(), volume.width_[a])),
          second_(hn::Set(Tag(), volume.clamped_[b])),
          clamped_(volume.clamped_),
          inverse_(volume.table_.inverse_determinants(a, b)) {}

    hn::Vec<Tag> operator()(uint32_t c) const {
      const Tag d;
      const auto faces = half_faces(first_, second_, hn::Load(d, clamped_ + c));
      return hn::Mul(faces, hn::LoadU(d, inverse_ + c));
    }

   private:
    hn::Vec<Tag> first_;
    hn::Vec<Tag> second_;
    const float* clamped_;
    const float* inverse_;
  };

  Pair pair(uint32_t a, uint32_t b) const { return {*this, a, b}; }

 private:
  // Half the area, times |det|. No fused multiply-add: the file's bytes rest on it.
  static hn::Vec<Tag> half_faces(hn::Vec<Tag> a, hn::Vec<Tag> b, hn::Vec<Tag> c) {
    return hn::Add(hn::Mul(b, c), hn::Mul(a, hn::Add(b, c)));
  }

  const BasisTable& table_;
  const float* width_;
  alignas(64) float clamped_[kMaxSearchedDirections];
};

TripleChoice choose_one(const BasisTable& table, const float* width, sobb_strategy strategy) {
  OneVolume volume(table, width);
  return BasisSearch<OneVolume>(table, volume).choose(strategy);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
