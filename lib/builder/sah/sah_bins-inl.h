// SPDX-License-Identifier: Apache-2.0
// Binning references by their centres, finding the best split, partitioning by it.
//
// A split's cost is sum area(side) blocks(side) / area(node), where blocks(n) = ceil(n / 4) is the
// number of triangle blocks that a leaf of n triangles takes.
#if defined(SOBB_BUILDER_SAH_SAH_BINS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_BUILDER_SAH_SAH_BINS_INL_H
#undef SOBB_BUILDER_SAH_SAH_BINS_INL_H
#else
#define SOBB_BUILDER_SAH_SAH_BINS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "builder/sah/sah_kernels.h"
#include "format/layout.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Tag4 = hn::FixedTag<float, 4>;
using Int4 = hn::FixedTag<int32_t, 4>;
// Boxes and references are eight words; wider vectors would reach past them.
using Tag8 = hn::CappedTag<float, 8>;

HWY_INLINE void grow(float* box, const float* by) {
  const Tag8 d;
  for (size_t i = 0; i < 8; i += hn::Lanes(d)) {
    hn::Store(hn::Min(hn::Load(d, by + i), hn::Load(d, box + i)), d, box + i);
  }
}

HWY_INLINE void copy(const SahReference& from, SahReference& to) {
  const Tag8 d;
  const auto* source = reinterpret_cast<const float*>(&from);  // all eight words of it
  auto* target = reinterpret_cast<float*>(&to);
  for (size_t i = 0; i < 8; i += hn::Lanes(d)) {
    hn::Store(hn::Load(d, source + i), d, target + i);
  }
}

// Twice the centre of a reference.
HWY_INLINE hn::Vec<Tag4> centre_of(const SahReference& reference) {
  const Tag4 d;
  // Lane 3 is masked: a primitive as a float may be anything.
  const auto axes = hn::FirstN(d, 3);
  return hn::IfThenElseZero(
      axes, hn::Sub(hn::Load(d, reference.lower), hn::Load(d, reference.minus_upper)));
}

HWY_INLINE hn::Vec<Int4> bins_of(hn::Vec<Tag4> centre, hn::Vec<Tag4> base, hn::Vec<Tag4> scale) {
  return hn::ConvertTo(Int4(), hn::Mul(hn::Sub(centre, base), scale));
}

void clear(Bins& bins, const Binning& binning) {
  const Tag8 d;
  const auto nothing = hn::Set(d, std::numeric_limits<float>::infinity());
  for (int axis = 0; axis < 3; ++axis) {
    for (uint32_t i = 0; i < binning.count; ++i) {
      for (size_t j = 0; j < 8; j += hn::Lanes(d)) {
        hn::Store(nothing, d, bins.box[axis][i].at + j);
      }
    }
    std::fill_n(bins.count[axis], binning.count, 0);
    if (binning.kind == SplitKind::kPlanes) std::fill_n(bins.ends[axis], binning.count, 0);
  }
}

void bin_centres(const SahReference* references, uint64_t count, const Binning& binning,
                 Bins& bins) {
  const Tag4 d;
  const auto base = hn::Load(d, binning.base);
  const auto scale = hn::Load(d, binning.scale);
  for (uint64_t i = 0; i < count; ++i) {
    const auto at = bins_of(centre_of(references[i]), base, scale);
    const auto x = static_cast<uint32_t>(hn::ExtractLane(at, 0));
    const auto y = static_cast<uint32_t>(hn::ExtractLane(at, 1));
    const auto z = static_cast<uint32_t>(hn::ExtractLane(at, 2));
    ++bins.count[0][x];
    ++bins.count[1][y];
    ++bins.count[2][z];
    grow(bins.box[0][x].at, references[i].lower);
    grow(bins.box[1][y].at, references[i].lower);
    grow(bins.box[2][z].at, references[i].lower);
  }
}

void merge(const Bins& from, const Binning& binning, Bins& into) {
  for (int axis = 0; axis < 3; ++axis) {
    for (uint32_t i = 0; i < binning.count; ++i) {
      grow(into.box[axis][i].at, from.box[axis][i].at);
      into.count[axis][i] += from.count[axis][i];
      if (binning.kind == SplitKind::kPlanes) into.ends[axis][i] += from.ends[axis][i];
    }
  }
}

// Computes areas of boxes over the area of a node's box. Lengths are measured in units of its
// longest side, so that nothing overflows.
class Areas {
 public:
  explicit Areas(const FlatBox& node) {
    float longest = 0;
    for (int k = 0; k < 3; ++k) longest = std::max(longest, -node.at[4 + k] - node.at[k]);
    scale_ = std::min(1 / longest, std::numeric_limits<float>::max());
    const float area = half_area(node);
    if (area > 0) inverse_ = 1 / area;
  }

  // 1 where the node has no area: then only blocks count.
  float operator()(const FlatBox& box) const {
    return inverse_ > 0 ? half_area(box) * inverse_ : 1;
  }

 private:
  HWY_INLINE float half_area(const FlatBox& box) const {
    const float x = (-box.at[4] - box.at[0]) * scale_;
    const float y = (-box.at[5] - box.at[1]) * scale_;
    const float z = (-box.at[6] - box.at[2]) * scale_;
    return x * (y + z) + y * z;
  }

  float scale_;
  float inverse_ = 0;
};

HWY_INLINE float blocks(uint64_t count) { return static_cast<float>(blocks_of(count)); }

Split find_split(const SahNode& node, const Bins& bins, const Binning& binning) {
  const Areas area(node.extent.box);
  Split best;
  for (int axis = 0; axis < 3; ++axis) {
    // By centres and lengths a reference is in one bin, and ends where it begins.
    const uint32_t* ends = binning.kind == SplitKind::kPlanes ? bins.ends[axis] : bins.count[axis];
    if (ends[0] == node.count) continue;  // all in one
    float right_cost[kMaxBins];
    uint64_t right_count[kMaxBins];
    FlatBox box = FlatBox::nothing();
    uint64_t side = 0;
    for (uint32_t i = binning.count - 1; i > 0; --i) {
      grow(box.at, bins.box[axis][i].at);
      side += ends[i];
      right_count[i] = side;
      right_cost[i] = side > 0 ? area(box) * blocks(side) : 0;
    }
    box = FlatBox::nothing();
    side = 0;
    for (uint32_t i = 1; i < binning.count && right_count[i] > 0; ++i) {
      grow(box.at, bins.box[axis][i - 1].at);
      side += bins.count[axis][i - 1];
      if (side == 0 || side + right_count[i] > node.count + node.room) continue;
      const float cost = area(box) * blocks(side) + right_cost[i];
      if (cost < best.cost) {
        best.cost = cost;
        best.axis = axis;
        best.bin = i;
        best.count[0] = side;
        best.count[1] = right_count[i];
      }
    }
  }
  best.binning = binning;
  if (best.axis < 0) return best;
  std::copy_n(best.count, 2, best.placed);
  for (uint32_t side = 0; side < 2; ++side) {
    best.box[side] = FlatBox::nothing();
    for (uint32_t i = side * best.bin; i < (side == 0 ? best.bin : binning.count); ++i) {
      grow(best.box[side].at, bins.box[best.axis][i].at);
    }
  }
  return best;
}

void partition_centres(const SahReference* references, uint64_t count, const Split& split,
                       SahReference* left, SahReference* right, SahExtent side[2]) {
  const Tag4 d;
  const Int4 di;
  const auto base = hn::Load(d, split.binning.base);
  const auto scale = hn::Load(d, split.binning.scale);
  // Along the other axes every reference counts as left.
  alignas(16) int32_t first[4] = {INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX};
  first[split.axis] = static_cast<int32_t>(split.bin);
  const auto bound = hn::Load(di, first);
  const auto none = hn::Set(d, std::numeric_limits<float>::infinity());
  auto left_lower = hn::Load(d, side[0].centres.lower);
  auto left_upper = hn::Load(d, side[0].centres.upper);
  auto right_lower = hn::Load(d, side[1].centres.lower);
  auto right_upper = hn::Load(d, side[1].centres.upper);
  for (uint64_t i = 0; i < count; ++i) {
    const auto centre = centre_of(references[i]);
    const auto at = bins_of(centre, base, scale);
    const bool is_left = hn::AllTrue(di, hn::Lt(at, bound));
    const auto of_left = hn::RebindMask(d, hn::Ne(hn::Set(di, is_left), hn::Zero(di)));
    left_lower = hn::Min(left_lower, hn::IfThenElse(of_left, centre, none));
    left_upper = hn::Max(left_upper, hn::IfThenElse(of_left, centre, hn::Neg(none)));
    right_lower = hn::Min(right_lower, hn::IfThenElse(of_left, none, centre));
    right_upper = hn::Max(right_upper, hn::IfThenElse(of_left, hn::Neg(none), centre));
    copy(references[i], *(is_left ? left : right));
    left += is_left;
    right += !is_left;
  }
  hn::Store(left_lower, d, side[0].centres.lower);
  hn::Store(left_upper, d, side[0].centres.upper);
  hn::Store(right_lower, d, side[1].centres.lower);
  hn::Store(right_upper, d, side[1].centres.upper);
}

void bound(const SahReference* references, uint64_t count, SahExtent& extent) {
  const Tag4 d;
  auto lower = hn::Load(d, extent.centres.lower);
  auto upper = hn::Load(d, extent.centres.upper);
  for (uint64_t i = 0; i < count; ++i) {
    const auto centre = centre_of(references[i]);
    lower = hn::Min(lower, centre);
    upper = hn::Max(upper, centre);
  }
  hn::Store(lower, d, extent.centres.lower);
  hn::Store(upper, d, extent.centres.upper);
  // The box stays in registers: a load from where the last step stored would wait for it.
  const Tag8 d8;
  for (size_t at = 0; at < 8; at += hn::Lanes(d8)) {
    auto box = hn::Load(d8, extent.box.at + at);
    for (uint64_t i = 0; i < count; ++i) {
      const auto* words = reinterpret_cast<const float*>(&references[i]);  // all eight of them
      box = hn::Min(hn::Load(d8, words + at), box);
    }
    hn::Store(box, d8, extent.box.at + at);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
