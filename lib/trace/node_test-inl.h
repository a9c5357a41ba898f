// SPDX-License-Identifier: Apache-2.0
// One ray against the volumes of all children of a node: a child is met where the greatest near
// distance of its slabs does not exceed the least far one. Included once for each Highway target.
//
// A class `Volumes` says what the volumes are, and so what the traversal is of:
//   kWidth            children a node at most
//   Node              with reference[kWidth] and meta[kWidth] as format/layout.h has them
//   Ray               the ray's side of the tests, made of (const TraceScene&, const ScaledRay&)
//   clip(ray, node, first, near, far)   clips the intervals of the children from `first` on
#if defined(SOBB_TRACE_NODE_TEST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_NODE_TEST_INL_H
#undef SOBB_TRACE_NODE_TEST_INL_H
#else
#define SOBB_TRACE_NODE_TEST_INL_H
#endif

#include <hwy/highway.h>

#include "trace/mask_bits-inl.h"
#include "trace/slab_clip-inl.h"
#include "trace/stack_key.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// The children that a ray meets: bit i of `mask`, and their keys.
template <int W>
struct NodeHits {
  uint32_t mask;
  alignas(64) uint32_t key_high[W];

  template <class Node>
  StackKey key(const Node& node, uint32_t child) const {
    return static_cast<StackKey>(key_high[child]) << 32 | node.reference[child];
  }
};

template <class Volumes, int W = Volumes::kWidth>
HWY_INLINE void test_node(const typename Volumes::Ray& ray, const typename Volumes::Node& node,
                          float tmin, float limit, NodeHits<W>& hits) {
  const ChildFloats<W> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  const hn::Rebind<uint16_t, decltype(d)> d16;
  hits.mask = 0;
  for (size_t first = 0; first < W; first += hn::Lanes(d)) {
    auto near = hn::Set(d, tmin);
    auto far = hn::Set(d, limit);
    Volumes::clip(ray, node, first, near, far);
    hits.mask |= mask_bits(d, hn::Le(near, far)) << first;
    // The upper half of a StackKey: distance, leaf bit, triangles.
    const auto meta = hn::PromoteTo(du, hn::Load(d16, node.meta + first));
    const auto leaf = hn::And(hn::ShiftRight<9>(meta), hn::Set(du, kLeafBit >> 9));
    const auto triangles = hn::And(meta, hn::Set(du, kTriangleMask));
    const auto distance =
        hn::And(hn::ShiftLeft<1>(hn::BitCast(du, near)), hn::Set(du, ~kKeyMetaMask));
    hn::Store(hn::Or(distance, hn::Or(leaf, triangles)), du, hits.key_high + first);
  }
  hits.mask &= (1U << child_count(node)) - 1;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
