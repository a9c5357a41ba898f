// SPDX-License-Identifier: Apache-2.0
// One ray against the volumes of all children of a node. Included once for each Highway target.
//
// Per slab: near = p_near r + near_k, far = p_far r + far_k; a child is met where the greatest near
// does not exceed the least far (T. Kay, J. Kajiya, "Ray Tracing Complex Scenes", 1986).
#if defined(SOBB_TRACE_NODE_TEST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_NODE_TEST_INL_H
#undef SOBB_TRACE_NODE_TEST_INL_H
#else
#define SOBB_TRACE_NODE_TEST_INL_H
#endif

#include <hwy/highway.h>

#include <bit>

#include "trace/ray_table-inl.h"
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

  StackKey key(const Node<W>& node, uint32_t child) const {
    return static_cast<StackKey>(key_high[child]) << 32 | node.reference[child];
  }
};

// As many children at once as a vector of the target has lanes.
template <int W>
using ChildFloats = hn::CappedTag<float, W>;

// The interval of one slab, with one direction for all children: its near plane is the lower one
// for a ray that rises along it.
template <int W, class V = hn::Vec<ChildFloats<W>>>
HWY_INLINE void clip_shared(const RayTable& table, const float (&slab)[2][W], uint32_t direction,
                            size_t first, V& near, V& far) {
  const ChildFloats<W> d;
  const uint32_t falls = std::bit_cast<uint32_t>(table.reciprocal[direction]) >> 31;
  const V r = hn::Set(d, table.reciprocal[direction]);
  near = hn::Max(
      near, hn::MulAdd(hn::Load(d, slab[falls] + first), r, hn::Set(d, table.near[direction])));
  far = hn::Min(
      far, hn::MulAdd(hn::Load(d, slab[1 - falls] + first), r, hn::Set(d, table.far[direction])));
}

// The same with a direction of its own for each child.
template <int W, class V = hn::Vec<ChildFloats<W>>>
HWY_INLINE void clip_own(const RayTable& table, const float (&slab)[2][W],
                         hn::Vec<hn::RebindToSigned<ChildFloats<W>>> direction, size_t first,
                         V& near, V& far) {
  const ChildFloats<W> d;
  const V r = hn::GatherIndex(d, table.reciprocal, direction);
  const V lower = hn::Mul(hn::Load(d, slab[0] + first), r);
  const V upper = hn::Mul(hn::Load(d, slab[1] + first), r);
  near = hn::Max(near, hn::Add(hn::Min(lower, upper), hn::GatherIndex(d, table.near, direction)));
  far = hn::Min(far, hn::Add(hn::Max(lower, upper), hn::GatherIndex(d, table.far, direction)));
}

// kAxes: the hierarchy is of AABBs, its directions are 0, 1, 2 everywhere.
template <int W, bool kAxes>
HWY_INLINE void test_node(const RayTable& table, const Node<W>& node, float tmin, float limit,
                          NodeHits<W>& hits) {
  const ChildFloats<W> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  const hn::RebindToSigned<decltype(d)> di;
  const hn::Rebind<uint16_t, decltype(d)> d16;
  hits.mask = 0;
  for (size_t first = 0; first < W; first += hn::Lanes(d)) {
    auto near = hn::Set(d, tmin);
    auto far = hn::Set(d, limit);
    if (kAxes || (node.meta[0] & kSharedBit) != 0) {
      const uint32_t basis = kAxes ? kAxesBasis : node.basis[0];
      for (int j = 0; j < 3; ++j) {
        clip_shared<W>(table, node.slab[j], basis_direction(basis, j), first, near, far);
      }
    } else {
      auto basis = hn::PromoteTo(di, hn::Load(d16, node.basis + first));
      for (int j = 0; j < 3; ++j) {
        clip_own<W>(table, node.slab[j], hn::And(basis, hn::Set(di, 31)), first, near, far);
        basis = hn::ShiftRight<5>(basis);
      }
    }
    uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Le(near, far), bits);
    hits.mask |= static_cast<uint32_t>(bits[0]) << first;
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
