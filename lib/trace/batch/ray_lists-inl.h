// SPDX-License-Identifier: Apache-2.0
// Lists of the rays that meet each child of a node, bundle by bundle against one child after the
// other.
#if defined(SOBB_TRACE_BATCH_RAY_LISTS_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_BATCH_RAY_LISTS_INL_H
#undef SOBB_TRACE_BATCH_RAY_LISTS_INL_H
#else
#define SOBB_TRACE_BATCH_RAY_LISTS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "base/simd/compact-inl.h"
#include "base/simd/mask_bits-inl.h"
#include "trace/batch/ray_bundle-inl.h"
#include "trace/batch/ray_entry.h"
#include "trace/ray/query.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// ListPart is the next bundle of a list: as many rays as a vector has lanes.
class ListPart {
  RayEntry padded_[kRayLanes];

 public:
  const RayEntry* entries;
  uint32_t filled;  // one bit per ray; in the other lanes the last one stands in

  HWY_INLINE ListPart(const RayEntry* list, uint32_t left) : entries(list) {
    const uint32_t some = std::min(kRayLanes, left);
    filled = low_bits(some);
    if (some == kRayLanes) return;
    for (uint32_t i = 0; i < kRayLanes; ++i) padded_[i] = list[std::min(i, some - 1)];
    entries = padded_;
  }
};

// Compacts a list to the rays that have no hit nearer than it. Returns how many they are.
HWY_INLINE uint32_t keep_open(RayEntry* list, uint32_t count, const SlabRay* ray) {
  const RayFloats d;
  const RayWords du;
  const hn::RebindToSigned<RayFloats> di;
  uint32_t open = 0;
  uint32_t i = 0;
  for (; i + kRayLanes <= count; i += kRayLanes) {
    const auto entries = hn::LoadU(du, list + i);
    constexpr int kStride = std::countr_zero(sizeof(SlabRay) / sizeof(float));
    static_assert(sizeof(SlabRay) == sizeof(float) << kStride);
    const auto rays = hn::AndNot(hn::Set(du, kEntryDistance), entries);
    const auto limits =
        hn::GatherIndex(d, &ray->limit, hn::BitCast(di, hn::ShiftLeft<kStride>(rays)));
    const auto distance = hn::BitCast(d, hn::And(entries, hn::Set(du, kEntryDistance)));
    const auto kept = hn::Le(distance, limits);
    open += store_compact(entries, mask_bits(d, kept), list + open);
  }
  for (; i < count; ++i) {
    const RayEntry entry = list[i];
    list[open] = entry;
    open += entry_distance(entry) <= ray[entry_ray(entry)].limit ? 1 : 0;
  }
  return open;
}

// The rays that meet each child, in the order of the list that they come from.
template <int W>
struct ChildLists {
  RayEntry* list[W];  // room for all rays and a vector more
  uint32_t count[W] = {};
  alignas(64) RayEntry nearest[W];  // the least entry of each list, that is by distance
};

// Fills the lists of the children. In any-hit queries entries have no distance, and none is
// nearest.
template <Query kQuery, int W, class NodeTest>
HWY_INLINE void fill_lists(const SlabRay* rays, const RayEntry* entries, uint32_t count,
                           uint32_t children, const NodeTest& test, ChildLists<W>& lists) {
  const RayFloats d;
  const RayWords du;
  alignas(64) RayEntry least[W][kRayLanes];
  for (uint32_t first = 0; first < count; first += kRayLanes) {
    const ListPart part(entries + first, count - first);
    const RayBundle bundle(rays, part.entries);
    const auto indices = hn::AndNot(hn::Set(du, kEntryDistance), hn::LoadU(du, part.entries));
    const auto of_bundle = test.of(bundle);
    for (uint32_t child = 0; child < children; ++child) {
      auto near = bundle.tmin;
      auto far = bundle.limit;
      test.clip(of_bundle, child, near, far);
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
      length += store_compact(met_entries, met, lists.list[child] + length);
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
