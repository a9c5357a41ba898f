// SPDX-License-Identifier: Apache-2.0
// Rows of four floats per lane to four vectors and back, in registers. A vector of any length is
// taken as blocks of 128 bits: lane i's row lies in block i / 4.
#if defined(SOBB_BASE_SIMD_TRANSPOSE_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
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

// Transposes within each block: rows a, b, c, e become columns, and the reverse.
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

// One row per block: those of lanes `first`, `first` + 4, ... `row(i)` is the address of lane i's.
template <class D, class Row>
HWY_INLINE hn::Vec<D> load_rows(D d, const Row& row, uint32_t first) {
  if constexpr (hn::MaxLanes(D()) == 4) {
    return hn::Load(d, row(first));
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, load_rows(half, row, first + hn::MaxLanes(half)),
                       load_rows(half, row, first));
  }
}
template <class D, class Row>
HWY_INLINE void store_rows(D d, hn::Vec<D> rows, const Row& row, uint32_t first) {
  if constexpr (hn::MaxLanes(D()) == 4) {
    hn::Store(rows, d, row(first));
  } else {
    const hn::Half<D> half;
    store_rows(half, hn::LowerHalf(half, rows), row, first);
    store_rows(half, hn::UpperHalf(half, rows), row, first + hn::MaxLanes(half));
  }
}

// The columns of all lanes' rows: column[j] has the j-th number of each.
template <class D, class Row>
HWY_INLINE void load_columns(D d, const Row& row, hn::Vec<D>* column) {
  transpose_blocks(load_rows(d, row, 0), load_rows(d, row, 1), load_rows(d, row, 2),
                   load_rows(d, row, 3), column);
}
template <class D, class Row>
HWY_INLINE void store_columns(D d, hn::Vec<D> a, hn::Vec<D> b, hn::Vec<D> c, hn::Vec<D> e,
                              const Row& row) {
  hn::Vec<D> rows[4];
  transpose_blocks(a, b, c, e, rows);
  for (uint32_t i = 0; i < 4; ++i) store_rows(d, rows[i], row, i);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
