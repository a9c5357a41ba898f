// SPDX-License-Identifier: Apache-2.0
// Lists of the rays that meet each child of a node. Included once for each Highway target.
#if defined(SOBB_TRACE_STREAM_LISTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_STREAM_LISTS_INL_H
#undef SOBB_TRACE_STREAM_LISTS_INL_H
#else
#define SOBB_TRACE_STREAM_LISTS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "trace/mask_bits-inl.h"
#include "trace/node_test-inl.h"
#include "trace/pack_table.h"
#include "trace/ray_entry.h"
#include "trace/transpose-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// As many lanes as a vector of children has, of entries.
template <int W>
using ChildEntries = hn::RebindToUnsigned<ChildFloats<W>>;

// One ray's entries with the children, kMissed set where it misses: near > far.
template <int W, class V = hn::Vec<ChildFloats<W>>>
HWY_INLINE hn::Vec<ChildEntries<W>> make_entries(uint32_t ray, V near, V far) {
  const ChildFloats<W> d;
  const ChildEntries<W> du;
  const auto distance = hn::And(hn::BitCast(du, near), hn::Set(du, kEntryDistance));
  const auto missed =
      hn::And(hn::BitCast(du, hn::VecFromMask(d, hn::Gt(near, far))), hn::Set(du, kMissed));
  return hn::Or(hn::Or(distance, hn::Set(du, ray)), missed);
}

// The lanes of entries that are not missed.
template <class VU>
HWY_INLINE uint32_t met_bits(VU entries) {
  const hn::RebindToFloat<hn::DFromV<VU>> d;
  return ~mask_bits(d, hn::MaskFromVec(hn::BitCast(d, entries))) & ((1U << hn::MaxLanes(d)) - 1);
}

// Stores the lanes of `entries` that `bits` names, packed, and what else fills a vector behind
// them. Returns how many there are. (Highway 1.0.3 copies the table of its own Compress to the
// stack each time, with GCC 12.)
template <class VU>
HWY_INLINE uint32_t store_packed(VU entries, uint32_t bits, RayEntry* to) {
  const hn::DFromV<VU> du;
  const hn::Rebind<uint8_t, decltype(du)> bytes;
  const auto lanes = hn::PromoteTo(du, hn::Load(bytes, kPackTable.lane[bits]));
  hn::StoreU(hn::TableLookupLanes(entries, hn::IndicesFromVec(du, lanes)), du, to);
  return static_cast<uint32_t>(std::popcount(bits));
}

// As many rows, by ray, as a vector has lanes, as columns, by child.
template <class D, class VU = hn::Vec<D>>
HWY_INLINE void transpose_square(D d, const RayEntry (*row)[hn::MaxLanes(D())], VU* column) {
  if constexpr (hn::MaxLanes(d) == 4) {
    transpose_blocks(hn::Load(d, row[0]), hn::Load(d, row[1]), hn::Load(d, row[2]),
                     hn::Load(d, row[3]), column);
  } else {
    // Rows i and i + 4 share a vector, so that all that is left is within blocks.
    const hn::Half<D> half;
    for (size_t at = 0; at < 8; at += 4) {
      const auto rows = [&](size_t i) HWY_ATTR {
        return hn::Combine(d, hn::Load(half, row[i + 4] + at), hn::Load(half, row[i] + at));
      };
      transpose_blocks(rows(0), rows(1), rows(2), rows(3), column + at);
    }
  }
}

// The rays that meet each child, in the order of the list that they come from.
template <int W>
struct ChildLists {
  RayEntry* list[W];  // room for all rays and a vector more
  uint32_t count[W] = {};
  alignas(64) RayEntry nearest[W];  // of each list the least entry, that is by distance
};

// Fills the lists. entries_of(ray, first) are the entries of the children from `first` on.
template <int W, class EntriesOf>
HWY_INLINE void fill_lists(const RayEntry* rays, uint32_t count, uint32_t children,
                           const EntriesOf& entries_of, ChildLists<W>& lists) {
  const ChildEntries<W> d;
  using VU = hn::Vec<decltype(d)>;
  constexpr uint32_t kLanes = hn::MaxLanes(d);
  for (uint32_t first_child = 0; first_child < children; first_child += kLanes) {
    VU least = hn::Set(d, ~RayEntry{0});
    for (uint32_t first = 0; first < count; first += kLanes) {
      const uint32_t rows = std::min(kLanes, count - first);
      alignas(64) RayEntry row[kLanes][kLanes];
      for (uint32_t i = 0; i < rows; ++i) {
        const VU entries = entries_of(entry_ray(rays[first + i]), first_child);
        least = hn::Min(least, entries);
        hn::Store(entries, d, row[i]);
      }
      VU column[kLanes];
      transpose_square(d, row, column);
      const uint32_t filled = (1U << rows) - 1;
      for (uint32_t i = 0; i < kLanes && first_child + i < children; ++i) {
        uint32_t& length = lists.count[first_child + i];
        length += store_packed(column[i], met_bits(column[i]) & filled,
                               lists.list[first_child + i] + length);
      }
    }
    hn::Store(least, d, lists.nearest + first_child);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
