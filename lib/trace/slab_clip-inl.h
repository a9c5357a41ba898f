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
  clip_slab<W>({hn::Set(d, table.reciprocal[direction]), hn::Set(d, table.near[direction]),
                hn::Set(d, table.far[direction])},
               slab, first, near, far);
}

// What the table has for the j-th direction of each child's own basis.
template <int W, class V = hn::Vec<ChildFloats<W>>>
HWY_INLINE SlabCoefficients<V> look_up(const RayTable& table, const uint16_t* basis, int j) {
  const ChildFloats<W> d;
  if constexpr (hn::MaxLanes(d) == 8) {
    // Permutations of the table's vectors, of 8 directions each: three bits of an index say which
    // lane, the two above which vector.
    const hn::RebindToUnsigned<decltype(d)> du;
    const hn::Rebind<uint16_t, decltype(d)> d16;
    const auto bases = hn::PromoteTo(du, hn::LoadU(d16, basis));
    const auto index =
        hn::IndicesFromVec(d, hn::And(hn::ShiftRightSame(bases, 5 * j), hn::Set(du, 7)));
    const auto second = hn::MaskFromVec(hn::BitCast(d, hn::ShiftLeftSame(bases, 28 - 5 * j)));
    const auto upper = hn::MaskFromVec(hn::BitCast(d, hn::ShiftLeftSame(bases, 27 - 5 * j)));
    const auto of = [&](const float* values) HWY_ATTR {
      const auto part = [&](int k) HWY_ATTR {
        return hn::TableLookupLanes(hn::Load(d, values + 8 * k), index);
      };
      return hn::IfThenElse(upper, hn::IfThenElse(second, part(3), part(2)),
                            hn::IfThenElse(second, part(1), part(0)));
    };
    return {of(table.reciprocal), of(table.near), of(table.far)};
  } else {
    alignas(16) float values[3][hn::MaxLanes(d)];
    for (size_t i = 0; i < hn::MaxLanes(d); ++i) {
      const uint32_t k = basis_direction(basis[i], j);
      values[0][i] = table.reciprocal[k];
      values[1][i] = table.near[k];
      values[2][i] = table.far[k];
    }
    return {hn::Load(d, values[0]), hn::Load(d, values[1]), hn::Load(d, values[2])};
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
