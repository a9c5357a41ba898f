// SPDX-License-Identifier: Apache-2.0
// The children of a node that a ray of a wave meets, chosen and pushed without a branch on which
// they are.
#if defined(SOBB_TRACE_WAVE_WAVE_CHILDREN_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_WAVE_WAVE_CHILDREN_INL_H
#undef SOBB_TRACE_WAVE_WAVE_CHILDREN_INL_H
#else
#define SOBB_TRACE_WAVE_WAVE_CHILDREN_INL_H
#endif

#include <hwy/highway.h>

#include <bit>
#include <cmath>

#include "base/simd/mask_bits-inl.h"
#include "trace/nodes/node_test-inl.h"
#include "trace/ray/query.h"
#include "trace/wave/push_table.h"
#include "trace/wave/wave_memory-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Limits by the number of children, which lanes without a child do not reach.
struct ChildLimits {
  alignas(64) float of[16][8] = {};

  constexpr ChildLimits() {
    for (int children = 0; children < 16; ++children) {
      for (int i = 0; i < 8; ++i) of[children][i] = i < children ? INFINITY : -1.0F;
    }
  }
};
inline constexpr ChildLimits kChildLimits;

template <class Volumes, Query kQuery>
class WaveChildren {
  static constexpr int kWidth = Volumes::kWidth;
  static constexpr size_t kLanes = hn::MaxLanes(ChildFloats<kWidth>());
  static constexpr size_t kParts = kWidth / kLanes;
  using Floats = ChildFloats<kWidth>;
  using Words = ChildWords<kWidth>;
  using Node = typename Volumes::Node;
  using Ray = WaveRay<kWidth>;

 public:
  // Tests all children.
  HWY_INLINE void test(const TraceScene& scene, Ray& ray, const Node& node) {
    const Floats d;
    const Words du;
    met_ = 0;
    for (size_t i = 0; i < kParts; ++i) {
      const size_t first = i * kLanes;
      auto near = hn::Set(d, ray.slabs.tmin);
      auto far = hn::Min(hn::Set(d, ray.slabs.limit),
                         hn::Load(d, kChildLimits.of[child_count(node)] + first));
      clip(scene, ray, node, first, near, far);
      const auto missed = hn::Gt(near, far);
      met_ |= (mask_bits(d, missed) ^ all_lanes(d)) << first;
      keys_[i] = key_triangle_words<kWidth>(node, first);
      if constexpr (kQuery == Query::kAny) continue;  // nothing is culled; the node's order
      keys_[i] = hn::Or(keys_[i], key_distance_words<kWidth>(near));
      // A missed child gets the largest key, which is sorted last.
      keys_[i] = hn::Or(keys_[i], hn::BitCast(du, hn::VecFromMask(d, missed)));
    }
  }

  // What to visit next, and the stack's top without it.
  struct Next {
    StackKey key;
    StackKey* top;
  };

  // Pushes the children met without the one to visit next, which it returns: the nearest, or in
  // an any-hit query the node's last. Where none is met it takes what is on top of the stack.
  HWY_INLINE Next push_all_but_next(const Node& node, StackKey* top) const {
    if constexpr (kQuery == Query::kAny) {
      top = push(top, met_, node) - 1;
      return {*top, top};
    }
    const uint32_t met = met_;
    const Words du;
    auto least = keys_[0];
    for (size_t i = 1; i < kParts; ++i) least = hn::Min(least, keys_[i]);
    least = hn::MinOfLanes(du, least);
    uint32_t least_bits = 0;
    for (size_t i = 0; i < kParts; ++i) {
      least_bits |= mask_bits(du, hn::Eq(keys_[i], least)) << (i * kLanes);
    }
    const auto nearest = static_cast<uint32_t>(std::countr_zero(least_bits));
    // The nearest is not pushed and popped again: where nothing is met the stack's top is known
    // before this visit ends.
    const StackKey nearest_key = StackKey{hn::GetLane(least)} << 32 | node.reference[nearest];
    const StackKey on_top = top[-1];
    top = push(top, met & ~(1U << nearest), node);
    const uint64_t none = (uint64_t{met} - 1) >> 63;  // compilers would make a branch of a choice
    return {nearest_key ^ ((nearest_key ^ on_top) & (0 - none)), top - none};
  }

 private:
  static HWY_INLINE void clip(const TraceScene& scene, Ray& ray, const Node& node, size_t first,
                              hn::Vec<Floats>& near, hn::Vec<Floats>& far) {
    if constexpr (HasFrameNodes<Volumes>) {
      if (!Volumes::on_frame(node)) [[unlikely]] {
        if (!ray.has_table) ray.make_table(scene);
        Volumes::clip(ray.directions(), node, first, near, far);
        return;
      }
    }
    clip_frame<kWidth>(ray.slabs, ray.near_plane, node, first, near, far);
  }

  // Pushes the children that a mask keeps. Returns the stack's new top.
  HWY_INLINE StackKey* push(StackKey* top, uint32_t kept, const Node& node) const {
    for (size_t i = 0; i < kParts; ++i) {
      const size_t first = i * kLanes;
      top = push_lanes(top, keys_[i], hn::Load(Words(), node.reference + first),
                       kept >> first & low_bits(kLanes));
    }
    return top;
  }

  template <class VU>
  static HWY_INLINE StackKey* push_lanes(StackKey* top, VU keys, VU references, uint32_t kept) {
    const hn::DFromV<VU> du;
    const hn::Rebind<uint8_t, decltype(du)> d8;
    const hn::Repartition<uint64_t, decltype(du)> d64;
    const auto lanes =
        hn::IndicesFromVec(du, hn::PromoteTo(du, hn::LoadU(d8, kPushTable.lanes<kLanes>(kept))));
    const VU high = hn::TableLookupLanes(keys, lanes);
    const VU low = hn::TableLookupLanes(references, lanes);
    const auto pushed = static_cast<uint32_t>(std::popcount(kept));
    hn::StoreU(hn::BitCast(d64, hn::InterleaveLower(du, low, high)), d64, top);
    if (pushed > kLanes / 2) [[unlikely]] {
      hn::StoreU(hn::BitCast(d64, hn::InterleaveUpper(du, low, high)), d64, top + kLanes / 2);
    }
    return top + pushed;
  }

  uint32_t met_;                 // one bit per child
  hn::Vec<Words> keys_[kParts];  // the upper halves of the children's keys
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
