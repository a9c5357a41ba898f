// SPDX-License-Identifier: Apache-2.0
// A ray's interval clipped with slabs. It is written in the plane's distance along the ray,
// near = p_near r + near_k and far = p_far r + far_k (slab_coefficients-inl.h): the interval left
// so far shrinks to what lies between them (T. Kay, J. Kajiya, "Ray Tracing Complex Scenes", 1986).
// Over the lanes vary the children of a node, or rays.
#if defined(SOBB_TRACE_NODES_SLAB_CLIP_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_NODES_SLAB_CLIP_INL_H
#undef SOBB_TRACE_NODES_SLAB_CLIP_INL_H
#else
#define SOBB_TRACE_NODES_SLAB_CLIP_INL_H
#endif

#include <hwy/highway.h>

#include "base/simd/transpose-inl.h"
#include "format/layout.h"
#include "trace/nodes/ray_table-inl.h"
#include "trace/ray/slab_coefficients-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// The children of a node over the lanes: as many at once as a vector of the target has.
template <int W>
using ChildFloats = hn::CappedTag<float, W>;
template <int W>
using ChildWords = hn::RebindToUnsigned<ChildFloats<W>>;

// Returns where planes are along the ray: p r + k.
template <class V>
HWY_INLINE V plane_distance(V plane, V scale, V offset) {
  return hn::MulAdd(plane, scale, offset);
}

// Clips with one slab whose near plane is known.
template <class V>
HWY_INLINE void clip_known(const SlabCoefficients<V>& c, V near_plane, V far_plane, V& near,
                           V& far) {
  near = hn::Max(near, plane_distance(near_plane, c.reciprocal, c.near));
  far = hn::Min(far, plane_distance(far_plane, c.reciprocal, c.far));
}

// Clips with one slab: the near plane is the lower one for a ray that rises along the direction,
// which the sign of r says. It is chosen after the planes are loaded, which then need not wait for
// r.
template <class V>
HWY_INLINE void clip_planes(const SlabCoefficients<V>& c, V lower, V upper, V& near, V& far) {
  clip_known(c, hn::IfNegativeThenElse(c.reciprocal, upper, lower),
             hn::IfNegativeThenElse(c.reciprocal, lower, upper), near, far);
}

// Clips with one slab of as many children as a vector has lanes, from child `first` on.
template <int W, class V = hn::Vec<ChildFloats<W>>>
HWY_INLINE void clip_slab(const SlabCoefficients<V>& c, const float (&slab)[2][W], size_t first,
                          V& near, V& far) {
  const ChildFloats<W> d;
  clip_planes(c, hn::Load(d, slab[0] + first), hn::Load(d, slab[1] + first), near, far);
}

// Clips likewise, with one direction for all children.
template <int W, class V = hn::Vec<ChildFloats<W>>>
HWY_INLINE void clip_shared(const RayTable& table, const float (&slab)[2][W], uint32_t direction,
                            size_t first, V& near, V& far) {
  const ChildFloats<W> d;
  const RayTable::Entry& entry = table.entry[direction];
  clip_slab<W>({hn::Set(d, entry.reciprocal), hn::Set(d, entry.near), hn::Set(d, entry.far)}, slab,
               first, near, far);
}

// The table's coefficients for the j-th direction of each child's own basis, by loads and
// shuffles: with them hair traces 17 % more rays, 8-wide, than with gathers.
template <int W, class V = hn::Vec<ChildFloats<W>>>
HWY_INLINE SlabCoefficients<V> look_up(const RayTable& table, const uint16_t* basis, int j) {
  const auto entry = [&](uint32_t child) HWY_ATTR {
    return &table.entry[basis_direction(basis[child], j)].reciprocal;
  };
  const ChildFloats<W> d;
  if constexpr (W == 2) {
    const hn::CappedTag<float, 4> d4;
    const auto first = hn::Load(d4, entry(0));
    const auto second = hn::Load(d4, entry(1));
    const auto low = hn::InterleaveLower(d4, first, second);
    const auto high = hn::InterleaveUpper(d4, first, second);
    return {hn::LowerHalf(d, low), hn::UpperHalf(d, low), hn::LowerHalf(d, high)};
  } else {
    V column[4];
    load_columns(d, entry, column);
    return {column[0], column[1], column[2]};
  }
}

// Clips likewise, with a direction of each child's own. `basis` starts at child `first`.
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
