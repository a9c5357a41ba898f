// SPDX-License-Identifier: Apache-2.0
// One ray before the four triangles of a block: the test of triangle_test.h, the same operations on
// the same numbers in every lane, so that it returns the same bits.
//
// A float filter in front of it gains nothing for one ray: it costs as much as the test. (For many
// rays before one triangle it does: batch/leaf_filter-inl.h.)
#if defined(SOBB_TRACE_TRIANGLES_WATERTIGHT_RAY_INL_H) == \
    defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_TRIANGLES_WATERTIGHT_RAY_INL_H
#undef SOBB_TRACE_TRIANGLES_WATERTIGHT_RAY_INL_H
#else
#define SOBB_TRACE_TRIANGLES_WATERTIGHT_RAY_INL_H
#endif

#include <hwy/highway.h>

#include <bit>

#include "base/simd/mask_bits-inl.h"
#include "format/layout.h"
#include "trace/ray/query.h"
#include "trace/ray/triangle_ray.h"
#include "trace/triangles/closest_hit.h"
#include "trace/triangles/watertight_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// What the test finds for as many triangles as a vector has lanes, as ClosestHit::offer() takes it.
struct TriangleHits {
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

class WatertightRay4 {
 public:
  explicit WatertightRay4(const sobb_ray& ray) : ray_(ray), tmin_(ray.tmin) {}
  // Makes its TriangleRay from parts.
  template <class... Parts>
  explicit WatertightRay4(float tmin, const Parts&... parts) : ray_(parts...), tmin_(tmin) {}

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

  // Finds the lanes of the block's triangles from `first` on that may be hits up to `limit`, to be
  // offered later. It has no branch.
  HWY_INLINE uint32_t find(const TriangleBlock& block, size_t first, float limit,
                           TriangleHits& hits) const {
    const Doubles d;
    const hn::Rebind<float, Doubles> df;
    const Weights of = weights(block, first);
    V sum;
    V t;
    const uint32_t lanes = mask_bits(d, distances(of, sum, t));
    hits.store(t, of.w[1], of.w[2], sum);
    return lanes & mask_bits(df, hn::Le(hn::DemoteTo(df, t), hn::Set(df, limit)));
  }

  // Offers hits that find() found to `best`. Returns whether it took one.
  template <Query kQuery>
  HWY_INLINE bool offer(const TriangleBlock& block, size_t first, uint32_t lanes,
                        const TriangleHits& hits, ClosestHit& best) const {
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

  // A vertex's coordinate along the k-th of the ray's axes, from the origin.
  HWY_INLINE V relative(const float (&vertex)[3][4], size_t first, int k) const {
    const Doubles d;
    const hn::Rebind<float, Doubles> df;
    return hn::Sub(hn::PromoteTo(d, hn::Load(df, vertex[ray_.axis[k]] + first)),
                   hn::Set(d, ray_.origin[k]));
  }

  // That coordinate projected along the ray.
  HWY_INLINE V projected(const float (&vertex)[3][4], size_t first, int k, double shear,
                         V depth) const {
    const Doubles d;
    return project(d, relative(vertex, first, k), hn::Set(d, shear), depth);
  }

  // The vertices' depths and weights, named as in triangle_test.h.
  struct Weights {
    V z[3];
    V w[3];
    hn::Mask<Doubles> inside;
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
    const V w0 = vertex_weight(x2, y2, x1, y1);
    const V w1 = vertex_weight(x0, y0, x2, y2);
    const V w2 = vertex_weight(x1, y1, x0, y0);
    return {{z0, z1, z2}, {w0, w1, w2}, is_inside(d, w0, w1, w2)};
  }

  // Finds where the ray meets the triangles' planes. Returns which triangles it hits.
  HWY_INLINE hn::Mask<Doubles> distances(const Weights& of, V& sum, V& t) const {
    const Doubles d;
    sum = hn::Add(hn::Add(of.w[0], of.w[1]), of.w[2]);
    t = hit_distance(of.w[0], of.w[1], of.w[2], sum, of.z[0], of.z[1], of.z[2],
                     hn::Set(d, ray_.direction_z));
    return is_hit(d, of.inside, sum, t);
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
    TriangleHits hits;
    hits.store(t, of.w[1], of.w[2], sum);
    return offer<kQuery>(block, first, lanes, hits, best);
  }

  TriangleRay ray_;
  float tmin_;
};

// Tests the triangles of a leaf. Returns whether `best` changed.
template <Query kQuery>
HWY_INLINE bool test_leaf(const WatertightRay4& ray, const TriangleBlock* block, uint32_t triangles,
                          ClosestHit& best) {
  bool found = false;
  for (uint32_t first = 0; first < triangles; first += 4, ++block) {
    found |= ray.test<kQuery>(*block, best);
    if (kQuery == Query::kAny && found) return true;
  }
  return found;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
