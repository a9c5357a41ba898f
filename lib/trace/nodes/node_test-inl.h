// SPDX-License-Identifier: Apache-2.0
// One ray against the volumes of all children of a node: a child is met where the greatest near
// distance of its slabs does not exceed the least far one. Included once for each Highway target.
//
// A class `Volumes` says what the volumes are, and so what the traversal is of:
//   kWidth            children a node at most
//   Node              with reference[kWidth] and meta[kWidth] as format/layout.h has them
//   Ray               the ray's side of the tests, made of (const TraceScene&, const ScaledRay&)
//   clip(ray, node, first, near, far)   clips the intervals of the children from `first` on; `ray`
//                     is a Ray, or its InRegisters if it has such
//   on_frame(node)    not in all: whether clip() can do with a FrameRay
#if defined(SOBB_TRACE_NODES_NODE_TEST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_NODES_NODE_TEST_INL_H
#undef SOBB_TRACE_NODES_NODE_TEST_INL_H
#else
#define SOBB_TRACE_NODES_NODE_TEST_INL_H
#endif

#include <hwy/highway.h>

#include "base/simd/mask_bits-inl.h"
#include "trace/nodes/slab_clip-inl.h"
#include "trace/nodes/stack_key.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// The children that a ray meets: bit i of `mask`; and how far away.
template <int W>
struct NodeHits {
  using D = ChildFloats<W>;
  static constexpr size_t kLanes = hn::MaxLanes(D());
  uint32_t mask;
  hn::Vec<D> near[W / kLanes];

  // The upper halves of the keys.
  template <class Node>
  HWY_INLINE void store_keys(const Node& node, uint32_t* to) const {
    const hn::RebindToUnsigned<D> du;
    const hn::Rebind<uint16_t, D> d16;
    for (size_t i = 0; i < W / kLanes; ++i) {
      const auto meta = hn::PromoteTo(du, hn::Load(d16, node.meta + i * kLanes));
      const auto triangles = hn::And(meta, hn::Set(du, kTriangleMask));
      const auto distance = hn::AndNot(hn::Set(du, kKeyMetaMask), hn::BitCast(du, near[i]));
      hn::Store(hn::Or(distance, triangles), du, to + i * kLanes);
    }
  }
};

// Between tmin and the limit.
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
  hits.mask &= (1U << child_count(node)) - 1;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
