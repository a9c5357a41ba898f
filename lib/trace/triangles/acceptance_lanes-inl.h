// SPDX-License-Identifier: Apache-2.0
// Acceptance of one triangle by as many rays as a vector has lanes: acceptance.h in lanes.
#if defined(SOBB_TRACE_TRIANGLES_ACCEPTANCE_LANES_INL_H) == \
    defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_TRIANGLES_ACCEPTANCE_LANES_INL_H
#undef SOBB_TRACE_TRIANGLES_ACCEPTANCE_LANES_INL_H
#else
#define SOBB_TRACE_TRIANGLES_ACCEPTANCE_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <bit>

#include "base/simd/mask_bits-inl.h"
#include "trace/triangles/acceptance.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// The lanes whose conditions allow the candidate; only those of `asked` are asked.
template <class List, class D>
HWY_INLINE hn::Mask<D> allowed_lanes(D d, hn::Vec<D> t, uint32_t primitive, hn::Mask<D> asked) {
  if constexpr (List::kNone) {
    return asked;
  } else {
    alignas(64) float each_t[hn::MaxLanes(D())];
    hn::Store(t, d, each_t);
    uint8_t bits[8] = {};  // as many as Highway may read and write
    hn::StoreMaskBits(d, asked, bits);
    for (uint32_t left = mask_bits(d, asked); left != 0; left &= left - 1) {
      const auto lane = static_cast<uint32_t>(std::countr_zero(left));
      if (!List::allow({each_t[lane], primitive})) {
        bits[lane / 8] = static_cast<uint8_t>(bits[lane / 8] & ~(1U << lane % 8));
      }
    }
    return hn::LoadMaskBits(d, bits);
  }
}

// The lanes that take a candidate; `best_t` and `best_primitive` are their best hits so far.
template <class List = QueryConditions, class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> accepting_lanes(D d, V t, uint32_t primitive, V tmin, V best_t,
                                       hn::Vec<hn::RebindToUnsigned<D>> best_primitive) {
  const hn::RebindToUnsigned<D> dw;
  const auto index = hn::Set(dw, primitive);
  const auto precedes =
      hn::Or(hn::Lt(t, best_t),
             hn::And(hn::Eq(t, best_t), hn::RebindMask(d, hn::Lt(index, best_primitive))));
  return allowed_lanes<List>(d, t, primitive, hn::And(precedes, hn::Ge(t, tmin)));
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
