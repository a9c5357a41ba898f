// SPDX-License-Identifier: Apache-2.0
// Four triangles at once before the ray: the test of triangle_test.h, the same operations on the
// same numbers in every lane, so that it returns the same bits. Included once for each Highway
// target.
//
// A filter in float in front of it is no gain: it costs as much as the test.
#if defined(SOBB_TRACE_TRIANGLES_WATERTIGHT_RAY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_TRIANGLES_WATERTIGHT_RAY_INL_H
#undef SOBB_TRACE_TRIANGLES_WATERTIGHT_RAY_INL_H
#else
#define SOBB_TRACE_TRIANGLES_WATERTIGHT_RAY_INL_H
#endif

#include <hwy/highway.h>

#include <bit>

#include "base/simd/mask_bits-inl.h"
#include "format/layout.h"
#include "trace/triangles/triangle_test.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// What a query is: the closest hit, or whether there is any.
enum class Query { kClosest, kAny };

// Of as many triangles as a vector has lanes, what ClosestHit::offer() wants.
struct BlockHits {
  static constexpr size_t kLanes = hn::MaxLanes(hn::CappedTag<double, 4>());
  alignas(32) double t[kLanes];
  alignas(32) double w1[kLanes];
  alignas(32) double w2[kLanes];
  alignas(32) double sum[kLanes];

  template <class V>
  HWY_INLINE void store(V t_of, V w1_of, V w2_of, V sum_of) {
    const hn::CappedTag<double, 4> d;
    hn::Store(t_of, d, t);
    hn::Store(w1_of, d, w1);
    hn::Store(w2_of, d, w2);
    hn::Store(sum_of, d, sum);
  }
};

// A ray before the triangles of a block.
class BlockRay {
 public:
  explicit BlockRay(const sobb_ray& ray) : ray_(ray), tmin_(ray.tmin) {}
  // Its TriangleRay made in place of what that is made of.
  template <class... Parts>
  explicit BlockRay(float tmin, const Parts&... parts) : ray_(parts...), tmin_(tmin) {}

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

  // Without a branch: the lanes of the block's triangles from `first` on that may be hits up to
  // `limit`, to be offered then.
  HWY_INLINE uint32_t meet(const TriangleBlock& block, size_t first, float limit,
                           BlockHits& hits) const {
    const Doubles d;
    const hn::Rebind<float, Doubles> df;
    const Weights of = weights(block, first);
    V sum;
    V t;
    const uint32_t lanes = mask_bits(d, distances(of, sum, t));
    hits.store(t, of.w[1], of.w[2], sum);
    return lanes & mask_bits(df, hn::Le(hn::DemoteTo(df, t), hn::Set(df, limit)));
  }

  // Offers hits to `best`. Returns whether it took one.
  template <Query kQuery>
  HWY_INLINE bool offer(const TriangleBlock& block, size_t first, uint32_t lanes,
                        const BlockHits& hits, ClosestHit& best) const {
    bool found = false;
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<uint32_t>(std::countr_zero(lanes));
      found |= best.offer(hits.t[lane], hits.w1[lane], hits.w2[lane], hits.sum[lane], tmin_,
                          block.primitive[first + lane]);
      if (kQuery == Query::kAny && found) return true;
    }
    return found;
  }

 private:
  using Doubles = hn::CappedTag<double, 4>;
  using V = hn::Vec<Doubles>;
  using M = hn::Mask<Doubles>;

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

  // As triangle_test.h has them.
  struct Weights {
    V z[3];
    V w[3];
    M inside;
  };

  HWY_INLINE Weights weights(const TriangleBlock& block, size_t first) const {
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
    const M inside = hn::Or(hn::Ge(hn::Min(hn::Min(w0, w1), w2), zero),
                            hn::Le(hn::Max(hn::Max(w0, w1), w2), zero));
    return {{z0, z1, z2}, {w0, w1, w2}, inside};
  }

  // Where the ray meets the triangles' planes, and which of the triangles themselves, ahead.
  HWY_INLINE M distances(const Weights& of, V& sum, V& t) const {
    const Doubles d;
    const V zero = hn::Zero(d);
    sum = hn::Add(hn::Add(of.w[0], of.w[1]), of.w[2]);
    t = hn::Div(hn::Add(hn::Add(hn::Mul(of.w[0], of.z[0]), hn::Mul(of.w[1], of.z[1])),
                        hn::Mul(of.w[2], of.z[2])),
                hn::Mul(sum, hn::Set(d, ray_.direction_z)));
    return hn::And(hn::And(of.inside, hn::Ne(sum, zero)), hn::Ge(t, zero));
  }

  template <Query kQuery>
  HWY_INLINE bool test_lanes(const TriangleBlock& block, size_t first, ClosestHit& best) const {
    const Doubles d;
    const Weights of = weights(block, first);
    if (mask_bits(d, of.inside) == 0) return false;
    V sum;
    V t;
    const uint32_t lanes = mask_bits(d, distances(of, sum, t));
    if (lanes == 0) return false;
    BlockHits hits;
    hits.store(t, of.w[1], of.w[2], sum);
    return offer<kQuery>(block, first, lanes, hits, best);
  }

  TriangleRay ray_;
  float tmin_;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
