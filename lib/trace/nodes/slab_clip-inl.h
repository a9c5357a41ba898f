// SPDX-License-Identifier: Apache-2.0
// A ray's interval within one slab of each child of a node. Included once for each Highway target.
//
// near = p_near r + near_k, far = p_far r + far_k (ray_table-inl.h); the interval left so far is
// clipped with it (T. Kay, J. Kajiya, "Ray Tracing Complex Scenes", 1986).
#if defined(SOBB_TRACE_NODES_SLAB_CLIP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_NODES_SLAB_CLIP_INL_H
#undef SOBB_TRACE_NODES_SLAB_CLIP_INL_H
#else
#define SOBB_TRACE_NODES_SLAB_CLIP_INL_H
#endif

#include <hwy/highway.h>

#include <bit>

#include "base/simd/transpose-inl.h"
#include "trace/nodes/ray_table-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// As many children at once as a vector of the target has lanes.
template <int W>
using ChildFloats = hn::CappedTag<float, W>;

// Clips with the intervals of one slab: the near plane is the lower one for a ray that rises along
// the direction, which the sign of r says. Chosen after the loads, for them not to wait for r.
template <int W, class V = hn::Vec<ChildFloats<W>>>
HWY_INLINE void clip_slab(const SlabCoefficients<V>& c, const float (&slab)[2][W], size_t first,
                          V& near, V& far) {
  const ChildFloats<W> d;
  const V lower = hn::Load(d, slab[0] + first);
  const V upper = hn::Load(d, slab[1] + first);
  const auto falls = hn::MaskFromVec(c.reciprocal);  // AVX2 and SSE4 read the sign bit alone
  near = hn::Max(near, hn::MulAdd(hn::IfThenElse(falls, upper, lower), c.reciprocal, c.near));
  far = hn::Min(far, hn::MulAdd(hn::IfThenElse(falls, lower, upper), c.reciprocal, c.far));
}

// With one direction for all children.
template <int W, class V = hn::Vec<ChildFloats<W>>>
HWY_INLINE void clip_shared(const RayTable& table, const float (&slab)[2][W], uint32_t direction,
                            size_t first, V& near, V& far) {
  const ChildFloats<W> d;
  const RayTable::Entry& entry = table.entry[direction];
  clip_slab<W>({hn::Set(d, entry.reciprocal), hn::Set(d, entry.near), hn::Set(d, entry.far)}, slab,
               first, near, far);
}

// Entries of four children, each child's in a block of 128 bits, as vectors over the children.
template <class V>
HWY_INLINE SlabCoefficients<V> columns_of(V a, V b, V c, V e) {
  V column[4];
  transpose_blocks(a, b, c, e, column);
  return {column[0], column[1], column[2]};
}

// What the table has for the j-th direction of each child's own basis. Loads and shuffles:
// with them hair traces 17 % more rays, 8-wide, than with gathers.
template <int W, class V = hn::Vec<ChildFloats<W>>>
HWY_INLINE SlabCoefficients<V> look_up(const RayTable& table, const uint16_t* basis, int j) {
  const hn::CappedTag<float, 4> d4;
  const auto entry = [&](int child) HWY_ATTR {
    return hn::Load(d4, &table.entry[basis_direction(basis[child], j)].reciprocal);
  };
  const ChildFloats<W> d;
  if constexpr (W == 2) {
    const auto low = hn::InterleaveLower(d4, entry(0), entry(1));
    const auto high = hn::InterleaveUpper(d4, entry(0), entry(1));
    return {hn::LowerHalf(d, low), hn::UpperHalf(d, low), hn::LowerHalf(d, high)};
  } else if constexpr (hn::MaxLanes(d) == 4) {
    return columns_of(entry(0), entry(1), entry(2), entry(3));
  } else {
    return columns_of(hn::Combine(d, entry(4), entry(0)), hn::Combine(d, entry(5), entry(1)),
                      hn::Combine(d, entry(6), entry(2)), hn::Combine(d, entry(7), entry(3)));
  }
}

// The same with a direction of its own for each child. `basis` are those of the children from
// `first` on.
template <int W, class V = hn::Vec<ChildFloats<W>>>
HWY_INLINE void clip_own(const RayTable& table, const float (&slab)[2][W], const uint16_t* basis,
                         int j, size_t first, V& near, V& far) {
  clip_slab<W>(look_up<W>(table, basis, j), slab, first, near, far);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
