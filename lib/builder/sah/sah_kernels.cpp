// SPDX-License-Identifier: Apache-2.0
#include "builder/sah/sah_kernels.h"

#include <algorithm>
#include <cmath>

#include "base/instruction_sets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "builder/sah/sah_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "builder/sah/sah_subtree-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {

const SahKernels& target_sah_kernels() {
  static constexpr SahKernels kKernels = {clear,       bin,       merge, find_split,
                                          count_parts, partition, bound, build};
  return kKernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sobb {

namespace {

// Another kind of split is tried only where the sides of the best split have this share of the
// node's area in common.
constexpr double kNotableOverlap = 0.2;

// A split by lengths must cost less than this share of the best split's cost: large and small
// triangles lie in the same place, and a ray meets both. Nodes per diffuse ray, by this share:
//                without    0.8    0.4
//   crown           14.4   11.9   11.9
//   San Miguel      18.3   23.1   18.2
constexpr float kLengthsAdvantage = 0.4F;

// A plane must cut this share of the references. Where it cuts fewer, the space that both sides of
// another split have in common is nearly empty, and costs less than the surface area heuristic
// believes. Nodes per diffuse ray, by this share:
//                      0   0.0005   0.01
//   city             7.1      6.8    6.6
//   San Miguel      13.7     13.7   17.9
constexpr double kLeastCut = 0.0005;

// Makes bins of equal width from `lower` to `upper`.
Binning make_bins(const float* lower, const float* upper, uint32_t count, SplitKind kind) {
  Binning binning = {};
  binning.count = count;
  binning.kind = kind;
  for (int k = 0; k < 3; ++k) {
    const float extent = upper[k] - lower[k];
    // Just below the count, so that the last bin is never passed.
    const float scale = 0.9999F * static_cast<float>(count) / extent;
    binning.base[k] = lower[k];
    binning.scale[k] = extent > 0 && std::isfinite(scale) ? scale : 0;
  }
  return binning;
}

// Half the area that both sides of a split have in common; half the node's where there is no split.
double overlap(const SahNode& node, const Split& split) {
  Box common = node.extent.box.box();
  if (split.axis >= 0) {
    for (const FlatBox& side : split.box) common.clip(side.box());
  }
  for (int k = 0; k < 3; ++k) {
    if (common.lower[k] > common.upper[k]) return 0;
  }
  return common.half_area();
}

}  // namespace

Binning make_binning(SplitKind kind, const SahNode& node, const Split& best,
                     const Cutting* cutting) {
  if (kind == SplitKind::kCentres) {
    const auto count = static_cast<uint32_t>(std::min<uint64_t>(kMaxBins, 4 + node.count / 16));
    return make_bins(node.extent.centres.lower, node.extent.centres.upper, count, kind);
  }
  const bool may_cut = cutting != nullptr && node.room > 0;
  if (kind == SplitKind::kPlanes && !may_cut) return {};
  const Box box = node.extent.box.box();
  const double common = overlap(node, best);
  if (!(common > kNotableOverlap * box.half_area())) return {};
  if (kind == SplitKind::kPlanes) {
    if (!(common > cutting->least_overlap)) return {};
    return make_bins(box.lower, box.upper, kSpatialBins, kind);
  }
  Binning binning = {};
  binning.count = kLengthBins;
  binning.kind = kind;
  for (int k = 0; k < 3; ++k) {
    binning.base[0] = std::max(binning.base[0], box.upper[k] - box.lower[k]);
  }
  return binning;
}

bool is_better(const SahNode& node, const Split& split, const Split& best) {
  switch (split.binning.kind) {
    case SplitKind::kCentres:
      return split.axis >= 0;
    case SplitKind::kLengths:
      return split.cost < kLengthsAdvantage * best.cost;
    default:
      break;
  }
  const auto more = static_cast<double>(split.count[0] + split.count[1] - node.count);
  return split.cost < best.cost && more >= kLeastCut * static_cast<double>(node.count);
}

void place_sides(const SahNode& node, const uint64_t count[2], SahNode side[2]) {
  const uint64_t all = count[0] + count[1];
  const uint64_t room = node.count + node.room - all;
  for (int k = 0; k < 2; ++k) {
    side[k].extent = SahExtent::nothing();
    side[k].count = count[k];
  }
  side[0].room = room * count[0] / all;
  side[1].room = room - side[0].room;
  side[0].begin = node.begin;
  side[1].begin = node.begin + side[0].count + side[0].room;
}

const SahKernels& sah_kernels(sobb_isa isa) { return SOBB_DISPATCH(isa, target_sah_kernels)(); }

}  // namespace sobb
#endif
