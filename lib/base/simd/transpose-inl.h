// SPDX-License-Identifier: Apache-2.0
// Rows to columns, in registers. Included once for each Highway target.
#if defined(SOBB_BASE_SIMD_TRANSPOSE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_BASE_SIMD_TRANSPOSE_INL_H
#undef SOBB_BASE_SIMD_TRANSPOSE_INL_H
#else
#define SOBB_BASE_SIMD_TRANSPOSE_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Transposes within each block of 128 bits: rows a, b, c, e become columns.
template <class V, class D = hn::DFromV<V>>
HWY_INLINE void transpose_blocks(V a, V b, V c, V e, V* column) {
  const D d;
  const hn::Repartition<uint64_t, D> pairs;
  const auto low_ab = hn::BitCast(pairs, hn::InterleaveLower(d, a, b));
  const auto low_ce = hn::BitCast(pairs, hn::InterleaveLower(d, c, e));
  const auto high_ab = hn::BitCast(pairs, hn::InterleaveUpper(d, a, b));
  const auto high_ce = hn::BitCast(pairs, hn::InterleaveUpper(d, c, e));
  column[0] = hn::BitCast(d, hn::InterleaveLower(pairs, low_ab, low_ce));
  column[1] = hn::BitCast(d, hn::InterleaveUpper(pairs, low_ab, low_ce));
  column[2] = hn::BitCast(d, hn::InterleaveLower(pairs, high_ab, high_ce));
  column[3] = hn::BitCast(d, hn::InterleaveUpper(pairs, high_ab, high_ce));
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
