// SPDX-License-Identifier: Apache-2.0
// One ray against the volumes of all children of a node: a child is met where the greatest near
// distance of its slabs does not exceed the least far one.
#if defined(SOBB_TRACE_NODES_NODE_TEST_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_NODES_NODE_TEST_INL_H
#undef SOBB_TRACE_NODES_NODE_TEST_INL_H
#else
#define SOBB_TRACE_NODES_NODE_TEST_INL_H
#endif

#include <hwy/highway.h>

#include "base/simd/mask_bits-inl.h"
#include "trace/nodes/node_volumes-inl.h"
#include "trace/nodes/stack_key.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// The two parts of the upper halves of children's stack keys: triangle counts of the children from
// `first` on, and distances.
template <int W, class Node>
HWY_INLINE hn::Vec<ChildWords<W>> key_triangle_words(const Node& node, size_t first) {
  const ChildWords<W> du;
  const hn::Rebind<uint16_t, ChildFloats<W>> d16;
  const auto meta = hn::PromoteTo(du, hn::Load(d16, node.meta + first));
  return hn::And(meta, hn::Set(du, kTriangleMask));
}
template <int W>
HWY_INLINE hn::Vec<ChildWords<W>> key_distance_words(hn::Vec<ChildFloats<W>> near) {
  const ChildWords<W> du;
  return hn::AndNot(hn::Set(du, kKeyMetaMask), hn::BitCast(du, near));
}

// The children that a ray meets, one bit each, and how far away.
template <int W>
struct NodeHits {
  using D = ChildFloats<W>;
  static constexpr size_t kLanes = hn::MaxLanes(D());
  uint32_t mask;
  hn::Vec<D> near[W / kLanes];

  // Stores the upper halves of the children's keys.
  template <class Node>
  HWY_INLINE void store_keys(const Node& node, uint32_t* to) const {
    for (size_t i = 0; i < W / kLanes; ++i) {
      const auto triangles = key_triangle_words<W>(node, i * kLanes);
      hn::Store(hn::Or(key_distance_words<W>(near[i]), triangles), ChildWords<W>(),
                to + i * kLanes);
    }
  }
};

// Tests all children, within the interval from tmin to the limit.
template <class Volumes, class Ray, int W = Volumes::kWidth, class V = hn::Vec<ChildFloats<W>>>
HWY_INLINE void test_node(const Ray& ray, const typename Volumes::Node& node, V tmin, V limit,
                          NodeHits<W>& hits) {
  const ChildFloats<W> d;
  hits.mask = 0;
  for (size_t i = 0; i < W / hits.kLanes; ++i) {
    V far = limit;
    hits.near[i] = tmin;
    Volumes::clip(ray, node, i * hits.kLanes, hits.near[i], far);
    hits.mask |= mask_bits(d, hn::Le(hits.near[i], far)) << (i * hits.kLanes);
  }
  hits.mask &= low_bits(child_count(node));
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
