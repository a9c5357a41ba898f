// SPDX-License-Identifier: Apache-2.0
// A ray's interval within one slab of each child of a node. Included once for each Highway target.
//
// near = p_near r + near_k, far = p_far r + far_k (ray_table-inl.h); the interval left so far is
// clipped with it (T. Kay, J. Kajiya, "Ray Tracing Complex Scenes", 1986).
#if defined(SOBB_TRACE_SLAB_CLIP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_SLAB_CLIP_INL_H
#undef SOBB_TRACE_SLAB_CLIP_INL_H
#else
#define SOBB_TRACE_SLAB_CLIP_INL_H
#endif

#include <hwy/highway.h>

#include <bit>

#include "trace/ray_table-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

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

// A lookup by each child's own direction, the j-th of its basis. Two children are too few to
// gather.
template <int W, class V = hn::Vec<ChildFloats<W>>>
HWY_INLINE V look_up(const float* values, const uint16_t* basis, int j) {
  const ChildFloats<W> d;
  if constexpr (W == 2) {
    return hn::InterleaveLower(d, hn::Set(d, values[basis_direction(basis[0], j)]),
                               hn::Set(d, values[basis_direction(basis[1], j)]));
  } else {
    const hn::RebindToSigned<ChildFloats<W>> di;
    const hn::Rebind<uint16_t, ChildFloats<W>> d16;
    const auto all = hn::PromoteTo(di, hn::Load(d16, basis));
    return hn::GatherIndex(d, values, hn::And(hn::ShiftRightSame(all, 5 * j), hn::Set(di, 31)));
  }
}

// The same with a direction of its own for each child. `basis` are those of the children from
// `first` on.
template <int W, class V = hn::Vec<ChildFloats<W>>>
HWY_INLINE void clip_own(const RayTable& table, const float (&slab)[2][W], const uint16_t* basis,
                         int j, size_t first, V& near, V& far) {
  const ChildFloats<W> d;
  const V r = look_up<W>(table.reciprocal, basis, j);
  const V lower = hn::Mul(hn::Load(d, slab[0] + first), r);
  const V upper = hn::Mul(hn::Load(d, slab[1] + first), r);
  near = hn::Max(near, hn::Add(hn::Min(lower, upper), look_up<W>(table.near, basis, j)));
  far = hn::Min(far, hn::Add(hn::Max(lower, upper), look_up<W>(table.far, basis, j)));
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
