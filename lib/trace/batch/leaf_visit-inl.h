// SPDX-License-Identifier: Apache-2.0
// Rays of a batch before the triangles of a leaf: one ray, or a list of them.
#if defined(SOBB_TRACE_BATCH_LEAF_VISIT_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_BATCH_LEAF_VISIT_INL_H
#undef SOBB_TRACE_BATCH_LEAF_VISIT_INL_H
#else
#define SOBB_TRACE_BATCH_LEAF_VISIT_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>

#include "trace/batch/batch_memory-inl.h"
#include "trace/batch/leaf_filter-inl.h"
#include "trace/batch/ray_lists-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

template <Query kQuery>
class LeafVisit {
 public:
  // `rays` are the batch's as the caller has them.
  LeafVisit(const TraceScene& scene, const sobb_ray* rays, Batch& batch)
      : scene_(scene), rays_(rays), batch_(batch) {}

  // Tests one ray.
  HWY_INLINE void test_ray(StackKey key, uint32_t ray) {
    if (test_leaf<kQuery>(watertight_ray(ray), scene_.blocks + key_index(key), key_triangles(key),
                          batch_.best(ray))) {
      batch_.shorten<kQuery>(ray);
    }
  }

  // Tests all rays of a list.
  HWY_INLINE void test_list(StackKey key, const RayEntry* list, uint32_t count) {
    const TriangleBlock* const block = scene_.blocks + key_index(key);
    const uint32_t triangles = key_triangles(key);
    if (count >= kFewestFiltered && filter_pays()) {
      const auto blocks = static_cast<uint32_t>(blocks_of(triangles));
      for (uint32_t i = 0; i < blocks; ++i) batch_.filter[i].make(scene_, block[i]);
      for (uint32_t first = 0; first < count; first += kRayLanes) {
        const ListPart part(list + first, count - first);
        test_bundle(block, triangles, part.entries, part.filled);
      }
    } else if (kQuery == Query::kAny) {
      for (uint32_t i = 0; i < count; ++i) test_ray(key, entry_ray(list[i]));
    } else {
      for (uint32_t i = 0; i < count; ++i) add_candidates(entry_ray(list[i]), block, triangles);
    }
    if (kQuery == Query::kClosest) take_hits();
  }

 private:
  // Lists of fewer rays go to the deciding test without the filter.
  static constexpr uint32_t kFewestFiltered = 4;
  // The filter's sure hits need no other test, unless a condition of acceptance is left to be
  // asked.
  static constexpr bool kTakesSureHits = kQuery == Query::kAny && QueryConditions::kNone;

  // The filter costs more than it saves where rays hit most of the leaves that they meet, unless
  // sure hits need no other test.
  bool filter_pays() const { return kQuery == Query::kAny || 2 * passed_ <= tested_; }

  // In any-hit queries few rays need the deciding test: what it takes is made at the first need.
  HWY_INLINE const WatertightRay4& watertight_ray(uint32_t i) {
    if (kQuery == Query::kAny && !batch_.has_watertight_ray[i]) {
      new (batch_.watertight_rays[i]) WatertightRay4(rays_[i]);
      batch_.has_watertight_ray[i] = true;
    }
    return batch_.watertight_ray(i);
  }

  HWY_INLINE void add_candidates(uint32_t ray, const TriangleBlock* block, uint32_t triangles) {
    batch_.candidates.add(ray, watertight_ray(ray), batch_.best(ray).limit, block, triangles);
    if (!batch_.candidates.has_room()) [[unlikely]]
      take_hits();
  }

  // A bundle before a leaf; `open` has one bit for each of its rays that is still looking.
  HWY_INLINE void test_bundle(const TriangleBlock* block, uint32_t triangles,
                              const RayEntry* entries, uint32_t open) {
    const FilterRays rays(RayBundle(batch_.ray, entries));
    const FilterBlock* prepared = batch_.filter;
    for (uint32_t first = 0; first < triangles && open != 0; first += 4, ++block, ++prepared) {
      uint32_t may_hit = 0;
      for (uint32_t i = 0; i < std::min(triangles - first, 4U); ++i) {
        const FilterVerdict of = filter<kQuery>(rays, *prepared, i);
        may_hit |= of.may_hit;
        if constexpr (kTakesSureHits) {
          for (uint32_t hit = of.hits & open; hit != 0; hit &= hit - 1) {
            const uint32_t ray = entry_ray(entries[std::countr_zero(hit)]);
            batch_.best(ray).take_sure_hit(block->primitive[i]);
            batch_.template shorten<kQuery>(ray);
          }
          open &= ~of.hits;
        }
      }
      if constexpr (kQuery == Query::kClosest) {
        tested_ += static_cast<uint32_t>(std::popcount(open));
        passed_ += static_cast<uint32_t>(std::popcount(may_hit & open));
      }
      for (uint32_t left = may_hit & open; left != 0; left &= left - 1) {
        const auto lane = static_cast<uint32_t>(std::countr_zero(left));
        const uint32_t ray = entry_ray(entries[lane]);
        if constexpr (kQuery == Query::kClosest) {
          add_candidates(ray, block, 4);
        } else if (watertight_ray(ray).template test<kQuery>(*block, batch_.best(ray))) {
          batch_.template shorten<kQuery>(ray);
          open &= ~(1U << lane);
        }
      }
    }
  }

  HWY_INLINE void take_hits() {
    batch_.candidates.take([&](uint32_t ray, const auto&... hits) HWY_ATTR {
      if (watertight_ray(ray).template offer<kQuery>(hits..., batch_.best(ray))) {
        batch_.template shorten<kQuery>(ray);
      }
    });
  }

  const TraceScene& scene_;
  const sobb_ray* rays_;
  Batch& batch_;
  uint32_t tested_ = 0;  // rays before blocks, by the filter,
  uint32_t passed_ = 0;  // and those that it could not tell from hits
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
