// SPDX-License-Identifier: Apache-2.0
// Triangles of leaves that rays may hit: the candidates of many rays are listed without a branch,
// then offered to the rays. A branch on what each ray meets would mostly be mispredicted.
#if defined(SOBB_TRACE_TRIANGLES_CANDIDATES_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_TRIANGLES_CANDIDATES_INL_H
#undef SOBB_TRACE_TRIANGLES_CANDIDATES_INL_H
#else
#define SOBB_TRACE_TRIANGLES_CANDIDATES_INL_H
#endif

#include <hwy/highway.h>

#include "format/layout.h"
#include "trace/triangles/watertight_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// `Name` is how the caller tells rays apart.
template <class Name>
class CandidateList {
 public:
  // Lists what a ray may hit of a leaf's triangles, up to `limit`. The list must have_room().
  HWY_INLINE void add(Name name, const WatertightRay4& ray, float limit, const TriangleBlock* block,
                      uint64_t triangles) {
    uint32_t count = count_;
    const TriangleBlock* const end = block + blocks_of(triangles);
    do {
      for (uint32_t first = 0; first < 4; first += TriangleHits::kLanes) {
        Entry& to = entry_[count];
        to.block = block;
        to.first = first;
        to.name = name;
        to.lanes = ray.find(*block, first, limit, to.hits);
        count += to.lanes != 0 ? 1 : 0;
      }
    } while (++block != end);
    count_ = count;
  }

  // Tells whether there is room for one more leaf.
  bool has_room() const { return count_ < kMost; }

  // Calls offer(name, block, first, lanes, hits) for each candidate, and empties the list.
  template <class Offer>
  HWY_INLINE void take(const Offer& offer) {
    for (uint32_t i = 0; i < count_; ++i) {
      const Entry& of = entry_[i];
      offer(of.name, *of.block, of.first, of.lanes, of.hits);
    }
    count_ = 0;
  }

 private:
  // An entry is as many triangles of a block as a vector has lanes; those of `lanes` may be hits.
  struct Entry {
    TriangleHits hits;
    const TriangleBlock* block;
    uint32_t first;
    uint32_t lanes;
    Name name;
  };
  static constexpr uint32_t kMost = 64;
  static constexpr uint32_t kPerLeaf = 4 * blocks_of(kTriangleMask) / TriangleHits::kLanes;

  uint32_t count_ = 0;
  Entry entry_[kMost + kPerLeaf];
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
