// SPDX-License-Identifier: Apache-2.0
// Splits by lengths, and the functions that take any kind of split.
#if defined(SOBB_BUILDER_SAH_SAH_KINDS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_BUILDER_SAH_SAH_KINDS_INL_H
#undef SOBB_BUILDER_SAH_SAH_KINDS_INL_H
#else
#define SOBB_BUILDER_SAH_SAH_KINDS_INL_H
#endif

#include <bit>

#include "builder/sah/sah_cuts-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

// Counts the steps of about the root of two from the longest side of all boxes down to that of a
// reference's box: a float's exponent and first bit count such steps.
HWY_INLINE uint32_t length_bin(const SahReference& reference, const Binning& binning) {
  float longest = 0;
  for (int k = 0; k < 3; ++k) {
    longest = std::max(longest, -reference.minus_upper[k] - reference.lower[k]);
  }
  const auto steps = [](float length) { return std::bit_cast<int32_t>(length) >> 22; };
  return static_cast<uint32_t>(std::clamp(steps(binning.base[0]) - steps(longest), 0,
                                          static_cast<int32_t>(kLengthBins) - 1));
}

void bin_lengths(const SahReference* references, uint64_t count, const Binning& binning,
                 Bins& bins) {
  for (uint64_t i = 0; i < count; ++i) {
    const uint32_t at = length_bin(references[i], binning);
    ++bins.count[0][at];
    grow(bins.box[0][at].at, references[i].lower);
  }
  // Along the other axes all are in one bin.
  for (int axis = 1; axis < 3; ++axis) bins.count[axis][0] += static_cast<uint32_t>(count);
}

void partition_lengths(const SahReference* references, uint64_t count, const Split& split,
                       SahReference* left, SahReference* right, SahExtent side[2]) {
  for (uint64_t i = 0; i < count; ++i) {
    const bool is_left = length_bin(references[i], split.binning) < split.bin;
    bound(&references[i], 1, side[is_left ? 0 : 1]);
    copy(references[i], *(is_left ? left : right));
    left += is_left;
    right += !is_left;
  }
}

void bin(const SahReference* references, uint64_t count, const Binning& binning,
         const Cutting* cutting, Bins& bins) {
  switch (binning.kind) {
    case SplitKind::kCentres:
      return bin_centres(references, count, binning, bins);
    case SplitKind::kLengths:
      return bin_lengths(references, count, binning, bins);
    case SplitKind::kPlanes:
      return bin_planes(references, count, binning, *cutting, bins);
  }
}

void partition(const SahReference* references, uint64_t count, const SahNode& node,
               const Split& split, const Cutting* cutting, SahReference* left, SahReference* right,
               SahExtent side[2]) {
  switch (split.binning.kind) {
    case SplitKind::kCentres:
      for (int k = 0; k < 2; ++k) grow(side[k].box.at, split.box[k].at);
      return partition_centres(references, count, split, left, right, side);
    case SplitKind::kLengths:
      return partition_lengths(references, count, split, left, right, side);
    case SplitKind::kPlanes:
      return partition_planes(references, count, node, split, *cutting, left, right, side);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
