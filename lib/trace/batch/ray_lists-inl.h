// SPDX-License-Identifier: Apache-2.0
// Lists of the rays that meet each child of a node: as many rays at once as a vector has lanes,
// against one child after the other. Included once for each Highway target.
#if defined(SOBB_TRACE_BATCH_RAY_LISTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_BATCH_RAY_LISTS_INL_H
#undef SOBB_TRACE_BATCH_RAY_LISTS_INL_H
#else
#define SOBB_TRACE_BATCH_RAY_LISTS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "base/simd/mask_bits-inl.h"
#include "base/simd/pack_table.h"
#include "trace/batch/ray_bundle-inl.h"
#include "trace/batch/ray_entry.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

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

// As many rays of a list as a vector has lanes.
class ListPart {
  static constexpr uint32_t kLanes = RayGroup::kLanes;
  RayEntry padded_[kLanes];

 public:
  const RayEntry* entries;
  uint32_t filled;  // a bit for each ray; in the other lanes the last one stands in

  HWY_INLINE ListPart(const RayEntry* list, uint32_t left) : entries(list) {
    const uint32_t some = std::min(kLanes, left);
    filled = (1U << some) - 1;
    if (some == kLanes) return;
    for (uint32_t i = 0; i < kLanes; ++i) padded_[i] = list[std::min(i, some - 1)];
    entries = padded_;
  }
};

// The rays that meet each child, in the order of the list that they come from.
template <int W>
struct ChildLists {
  RayEntry* list[W];  // room for all rays and a vector more
  uint32_t count[W] = {};
  alignas(64) RayEntry nearest[W];  // of each list the least entry, that is by distance
};

// Fills the lists. Where any hit will do, entries have no distance, and none is nearest.
template <Query kQuery, int W, class NodeTest>
HWY_INLINE void fill_lists(const SlabRay* rays, const RayEntry* entries, uint32_t count,
                           uint32_t children, const NodeTest& test, ChildLists<W>& lists) {
  const RayFloats d;
  const RayWords du;
  constexpr uint32_t kLanes = RayGroup::kLanes;
  alignas(64) RayEntry least[W][kLanes];
  for (uint32_t first = 0; first < count; first += kLanes) {
    const ListPart part(entries + first, count - first);
    const RayGroup group(rays, part.entries);
    const auto indices = hn::AndNot(hn::Set(du, kEntryDistance), hn::LoadU(du, part.entries));
    const auto of_group = test.of(group);
    for (uint32_t child = 0; child < children; ++child) {
      auto near = group.tmin;
      auto far = group.limit;
      test.clip(of_group, child, near, far);
      const uint32_t met = mask_bits(d, hn::Le(near, far)) & part.filled;
      auto met_entries = indices;
      if constexpr (kQuery == Query::kClosest) {
        const auto distances = hn::And(hn::BitCast(du, near), hn::Set(du, kEntryDistance));
        met_entries = hn::Or(indices, distances);
        const auto missed = hn::Gt(near, far);
        auto nearest = hn::Or(met_entries, hn::BitCast(du, hn::VecFromMask(d, missed)));
        if (first != 0) nearest = hn::Min(nearest, hn::Load(du, least[child]));
        hn::Store(nearest, du, least[child]);
      }
      uint32_t& length = lists.count[child];
      length += store_packed(met_entries, met, lists.list[child] + length);
    }
  }
  for (uint32_t child = 0; child < children; ++child) {
    lists.nearest[child] =
        kQuery == Query::kAny ? 0 : hn::GetLane(hn::MinOfLanes(du, hn::Load(du, least[child])));
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
