// SPDX-License-Identifier: Apache-2.0
// Splits in the middle: of the references' centres, along the axis where these are furthest apart.
#if defined(SOBB_BUILDER_SAH_SAH_MIDDLE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_BUILDER_SAH_SAH_MIDDLE_INL_H
#undef SOBB_BUILDER_SAH_SAH_MIDDLE_INL_H
#else
#define SOBB_BUILDER_SAH_SAH_MIDDLE_INL_H
#endif

#include "builder/sah/sah_bins-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

HWY_INLINE int longest_axis(const Centres& centres) {
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    const float extent = centres.upper[k] - centres.lower[k];
    if (extent > centres.upper[axis] - centres.lower[axis]) axis = k;
  }
  return axis;
}

// The number that centres are compared with. At least one is below it, at least one is not.
HWY_INLINE float middle(const Centres& centres, int axis) {
  const float half = (centres.upper[axis] - centres.lower[axis]) / 2;
  const float middle = centres.lower[axis] + half;
  return middle > centres.lower[axis] ? middle : centres.upper[axis];
}

// Returns whether the centres differ.
HWY_INLINE bool has_middle(const SahNode& node) {
  const Centres& centres = node.extent.centres;
  const int axis = longest_axis(centres);
  return centres.upper[axis] > centres.lower[axis];
}

// Writes the left side's references from `to` on, the right side's behind them in reverse.
void split_in_middle(const SahReference* references, const SahNode& node, SahReference* to,
                     SahNode child[2]) {
  const int axis = longest_axis(node.extent.centres);
  const float bound_of_left = middle(node.extent.centres, axis);
  SahReference* left = to;
  SahReference* right = to + node.count;
  for (uint64_t i = 0; i < node.count; ++i) {
    const SahReference& reference = references[i];
    const bool is_left = reference.lower[axis] - reference.minus_upper[axis] < bound_of_left;
    right -= !is_left;
    copy(reference, *(is_left ? left : right));
    left += is_left;
  }
  const auto count = static_cast<uint64_t>(left - to);
  child[0] = {SahExtent::nothing(), node.begin, count, 0};
  child[1] = {SahExtent::nothing(), node.begin + count, node.count - count, 0};
  bound(to, count, child[0].extent);
  bound(left, child[1].count, child[1].extent);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
