// SPDX-License-Identifier: Apache-2.0
// Triangles of leaves that rays may hit: all rays' are listed without a branch, then offered to the
// rays. A branch on what each meets would mostly be mispredicted. Included once for each Highway
// target.
#if defined(SOBB_TRACE_TRIANGLES_CANDIDATES_INL_H) == defined(HWY_TARGET_TOGGLE)
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

// `Name` is how rays are told apart.
template <class Name>
class LeafHits {
 public:
  // Lists what a ray may hit of a leaf's triangles, up to `limit`. There must be room().
  HWY_INLINE void add(Name name, const BlockRay& ray, float limit, const TriangleBlock* block,
                      uint64_t triangles) {
    uint32_t count = count_;
    const TriangleBlock* const end = block + blocks_of(triangles);
    do {
      for (uint32_t first = 0; first < 4; first += BlockHits::kLanes) {
        Candidate& to = candidate_[count];
        to.block = block;
        to.first = first;
        to.name = name;
        to.lanes = ray.meet(*block, first, limit, to.hits);
        count += to.lanes != 0 ? 1 : 0;
      }
    } while (++block != end);
    count_ = count;
  }

  // For one more leaf.
  bool room() const { return count_ < kMost; }

  // Calls offer(name, block, first, lanes, hits) for each of the list, which is empty then.
  template <class Offer>
  HWY_INLINE void take(const Offer& offer) {
    for (uint32_t i = 0; i < count_; ++i) {
      const Candidate& of = candidate_[i];
      offer(of.name, *of.block, of.first, of.lanes, of.hits);
    }
    count_ = 0;
  }

 private:
  struct Candidate {
    BlockHits hits;
    const TriangleBlock* block;
    uint32_t first;
    uint32_t lanes;
    Name name;
  };
  static constexpr uint32_t kMost = 64;
  static constexpr uint32_t kOfALeaf = 4 * blocks_of(kTriangleMask) / BlockHits::kLanes;

  uint32_t count_ = 0;
  Candidate candidate_[kMost + kOfALeaf];
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
