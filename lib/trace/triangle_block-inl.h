// SPDX-License-Identifier: Apache-2.0
// Four triangles at once before the ray: the test of triangle_test.h, the same operations on the
// same numbers in every lane, so that it returns the same bits. Included once for each Highway
// target.
//
// A filter in float in front of it is no gain: it costs as much as the test.
#if defined(SOBB_TRACE_TRIANGLE_BLOCK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_TRIANGLE_BLOCK_INL_H
#undef SOBB_TRACE_TRIANGLE_BLOCK_INL_H
#else
#define SOBB_TRACE_TRIANGLE_BLOCK_INL_H
#endif

#include <hwy/highway.h>

#include <bit>

#include "format/layout.h"
#include "trace/mask_bits-inl.h"
#include "trace/triangle_test.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// What a query is: the closest hit, or whether there is any.
enum class Query { kClosest, kAny };

// A ray before the triangles of a block.
class BlockRay {
 public:
  explicit BlockRay(const sobb_ray& ray) : BlockRay(TriangleRay(ray), ray.tmin) {}
  BlockRay(const TriangleRay& ray, float tmin) : ray_(ray), tmin_(tmin) {}

  // Offers the block's hits to `best`. Returns whether it took one.
  template <Query kQuery>
  HWY_INLINE bool test(const TriangleBlock& block, ClosestHit& best) const {
    bool found = false;
    for (size_t first = 0; first < 4; first += hn::MaxLanes(Doubles())) {
      found |= test_lanes<kQuery>(block, first, best);
      if (kQuery == Query::kAny && found) return true;
    }
    return found;
  }

 private:
  using Doubles = hn::CappedTag<double, 4>;
  using V = hn::Vec<Doubles>;

  // A vertex's coordinate along the k-th of the ray's axes, from the origin.
  HWY_INLINE V relative(const float (&vertex)[3][4], size_t first, int k) const {
    const Doubles d;
    const hn::Rebind<float, Doubles> df;
    return hn::Sub(hn::PromoteTo(d, hn::Load(df, vertex[ray_.axis[k]] + first)),
                   hn::Set(d, ray_.origin[k]));
  }

  // The same once projected along the ray, rounded to float.
  HWY_INLINE V projected(const float (&vertex)[3][4], size_t first, int k, double shear,
                         V depth) const {
    const Doubles d;
    const hn::Rebind<float, Doubles> df;
    const V at = hn::Sub(relative(vertex, first, k), hn::Mul(hn::Set(d, shear), depth));
    return hn::PromoteTo(d, hn::DemoteTo(df, at));
  }

  template <Query kQuery>
  HWY_INLINE bool test_lanes(const TriangleBlock& block, size_t first, ClosestHit& best) const {
    const Doubles d;
    const V z0 = relative(block.vertex[0], first, 2);
    const V z1 = relative(block.vertex[1], first, 2);
    const V z2 = relative(block.vertex[2], first, 2);
    const V x0 = projected(block.vertex[0], first, 0, ray_.shear_x, z0);
    const V x1 = projected(block.vertex[1], first, 0, ray_.shear_x, z1);
    const V x2 = projected(block.vertex[2], first, 0, ray_.shear_x, z2);
    const V y0 = projected(block.vertex[0], first, 1, ray_.shear_y, z0);
    const V y1 = projected(block.vertex[1], first, 1, ray_.shear_y, z1);
    const V y2 = projected(block.vertex[2], first, 1, ray_.shear_y, z2);

    const V w0 = hn::Sub(hn::Mul(x2, y1), hn::Mul(y2, x1));
    const V w1 = hn::Sub(hn::Mul(x0, y2), hn::Mul(y0, x2));
    const V w2 = hn::Sub(hn::Mul(x1, y0), hn::Mul(y1, x0));
    // Where a weight is not a number, from overflow, t is not either.
    const V zero = hn::Zero(d);
    const auto inside = hn::Or(hn::Ge(hn::Min(hn::Min(w0, w1), w2), zero),
                               hn::Le(hn::Max(hn::Max(w0, w1), w2), zero));
    if (mask_bits(d, inside) == 0) return false;

    const V sum = hn::Add(hn::Add(w0, w1), w2);
    const V t = hn::Div(hn::Add(hn::Add(hn::Mul(w0, z0), hn::Mul(w1, z1)), hn::Mul(w2, z2)),
                        hn::Mul(sum, hn::Set(d, ray_.direction_z)));
    const auto hits = hn::And(hn::And(inside, hn::Ne(sum, zero)), hn::Ge(t, zero));
    uint32_t lanes = mask_bits(d, hits);
    if (lanes == 0) return false;
    return offer<kQuery>(block, first, lanes, t, w1, w2, sum, best);
  }

  template <Query kQuery>
  HWY_INLINE bool offer(const TriangleBlock& block, size_t first, uint32_t lanes, V t, V w1, V w2,
                        V sum, ClosestHit& best) const {
    const Doubles d;
    alignas(32) double of[4][hn::MaxLanes(Doubles())];
    hn::Store(t, d, of[0]);
    hn::Store(w1, d, of[1]);
    hn::Store(w2, d, of[2]);
    hn::Store(sum, d, of[3]);
    bool found = false;
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<uint32_t>(std::countr_zero(lanes));
      found |= best.offer(of[0][lane], of[1][lane], of[2][lane], of[3][lane], tmin_,
                          block.primitive[first + lane]);
      if (kQuery == Query::kAny && found) return true;
    }
    return found;
  }

  TriangleRay ray_;
  float tmin_;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
