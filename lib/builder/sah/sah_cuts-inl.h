// SPDX-License-Identifier: Apache-2.0
// Spatial splits: references are in all bins that they meet, and a plane cuts them.
#if defined(SOBB_BUILDER_SAH_SAH_CUTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_BUILDER_SAH_SAH_CUTS_INL_H
#undef SOBB_BUILDER_SAH_SAH_CUTS_INL_H
#else
#define SOBB_BUILDER_SAH_SAH_CUTS_INL_H
#endif

#include "builder/boxes/clip.h"
#include "builder/sah/sah_bins-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

// The first and the last bin that a reference meets along one axis.
struct BinRange {
  uint32_t first;
  uint32_t last;
};

// A bin includes its lower plane and excludes its upper one: in scenes made of boxes much lies on
// planes.
HWY_INLINE BinRange range_of(const SahReference& reference, const Binning& binning, int axis) {
  const float base = binning.base[axis];
  const float scale = binning.scale[axis];
  const auto first = static_cast<int32_t>((reference.lower[axis] - base) * scale);
  const float end = (-reference.minus_upper[axis] - base) * scale;
  const auto whole = static_cast<int32_t>(end);
  const int32_t last = static_cast<float>(whole) < end ? whole : whole - 1;
  return {static_cast<uint32_t>(first), static_cast<uint32_t>(std::max(first, last))};
}

// The lower plane of a bin.
HWY_INLINE float plane_of(const Binning& binning, int axis, uint32_t bin) {
  return binning.base[axis] + static_cast<float>(bin) / binning.scale[axis];
}

// A triangle's corners as boxes. The parts of a triangle in bins only estimate a split's cost, so
// their rounding does not matter.
struct FlatTriangle {
  FlatBox corner[3];

  FlatTriangle(uint32_t primitive, const Cutting& cutting) {
    for (int i = 0; i < 3; ++i) {
      double at[3];
      cutting.frame.turn(cutting.mesh.corner(primitive, i), at);
      for (int k = 0; k < 3; ++k) {
        corner[i].at[k] = static_cast<float>(at[k]);
        corner[i].at[4 + k] = -corner[i].at[k];
      }
      corner[i].at[3] = corner[i].at[7] = 0;
    }
  }
};

// a + s (b - a)
HWY_INLINE FlatBox between(const FlatBox& a, const FlatBox& b, float s) {
  const Tag8 d;
  FlatBox point;
  for (size_t i = 0; i < 8; i += hn::Lanes(d)) {
    const auto from = hn::Load(d, a.at + i);
    const auto step = hn::Mul(hn::Set(d, s), hn::Sub(hn::Load(d, b.at + i), from));
    hn::Store(hn::Add(from, step), d, point.at + i);
  }
  return point;
}

// Shrinks `box` to what it shares with a reference's box. Returns false where that is nothing.
HWY_INLINE bool clip(FlatBox& box, const SahReference& reference) {
  const Tag8 d;
  const float* within = reference.lower;  // the first of all eight words
  for (size_t i = 0; i < 8; i += hn::Lanes(d)) {
    hn::Store(hn::Max(hn::Load(d, within + i), hn::Load(d, box.at + i)), d, box.at + i);
  }
  for (int k = 0; k < 3; ++k) {
    if (box.at[k] > -box.at[4 + k]) return false;
  }
  return true;
}

// Grows all bins that a reference meets along an axis by the part of its triangle within them.
void bin_parts(const FlatTriangle& triangle, const SahReference& reference, const Binning& binning,
               int axis, BinRange range, FlatBox* boxes) {
  FlatBox part[kMaxBins];
  std::fill(part + range.first, part + range.last + 1, FlatBox::nothing());
  const auto first = static_cast<int32_t>(range.first);
  const auto last = static_cast<int32_t>(range.last);
  for (int i = 0; i < 3; ++i) {
    const FlatBox* a = &triangle.corner[i];
    const FlatBox* b = &triangle.corner[(i + 1) % 3];
    const float base = binning.base[axis];
    const auto bin_of = [&](const FlatBox* point) {
      const float at = (point->at[axis] - base) * binning.scale[axis];
      return static_cast<int32_t>(std::clamp(at, -1.0F, static_cast<float>(kMaxBins)));
    };
    const int32_t own = bin_of(a);
    if (own >= first && own <= last) grow(part[own].at, a->at);
    if (a->at[axis] > b->at[axis]) std::swap(a, b);
    const int32_t end = std::min(bin_of(b), last);
    for (int32_t bin = std::max(bin_of(a), first) + 1; bin <= end; ++bin) {
      const float plane = plane_of(binning, axis, static_cast<uint32_t>(bin));
      const float s = (plane - a->at[axis]) / (b->at[axis] - a->at[axis]);
      const FlatBox point = between(*a, *b, s);
      grow(part[bin - 1].at, point.at);
      grow(part[bin].at, point.at);
    }
  }
  for (uint32_t bin = range.first; bin <= range.last; ++bin) {
    if (clip(part[bin], reference)) grow(boxes[bin].at, part[bin].at);
  }
}

void bin_planes(const SahReference* references, uint64_t count, const Binning& binning,
                const Cutting& cutting, Bins& bins) {
  for (uint64_t i = 0; i < count; ++i) {
    const SahReference& reference = references[i];
    BinRange range[3];
    bool is_cut = false;
    for (int axis = 0; axis < 3; ++axis) {
      range[axis] = range_of(reference, binning, axis);
      ++bins.count[axis][range[axis].first];
      ++bins.ends[axis][range[axis].last];
      if (range[axis].first == range[axis].last) {
        grow(bins.box[axis][range[axis].first].at, reference.lower);
      } else {
        is_cut = true;
      }
    }
    if (!is_cut) continue;
    const FlatTriangle triangle(reference.primitive, cutting);
    for (int axis = 0; axis < 3; ++axis) {
      if (range[axis].first == range[axis].last) continue;
      bin_parts(triangle, reference, binning, axis, range[axis], bins.box[axis]);
    }
  }
}

// The sides of a split that a reference is on, and what it is there.
struct Parts {
  bool is_on[2];
  SahReference part[2];
};

// Puts references on the sides of one spatial split: on one side, whole, where that costs no more,
// else a part on either side.
class Cutter {
 public:
  Cutter(const SahNode& node, const Split& split, const Cutting& cutting)
      : split_(split),
        cutting_(cutting),
        area_(node.extent.box),
        plane_(plane_of(split.binning, split.axis, split.bin)) {
    for (int side = 0; side < 2; ++side) {
      side_area_[side] = area_(split.box[side]);
      side_count_[side] = static_cast<float>(split.count[side]);
    }
  }

  void operator()(const SahReference& reference, Parts& parts) const {
    const BinRange range = range_of(reference, split_.binning, split_.axis);
    parts.is_on[0] = range.first < split_.bin;
    parts.is_on[1] = range.last >= split_.bin;
    parts.part[0] = parts.part[1] = reference;
    if (!parts.is_on[0] || !parts.is_on[1]) return;
    const int whole_on = cheaper_whole(reference);
    if (whole_on >= 0) {
      parts.is_on[1 - whole_on] = false;
    } else {
      cut(reference, parts);
    }
  }

 private:
  // The side on which the whole reference costs no more than a part on either side does, by
  // sum area(side) count(side); -1 where there is none.
  int cheaper_whole(const SahReference& reference) const {
    float least = side_area_[0] * side_count_[0] + side_area_[1] * side_count_[1];
    int best = -1;
    for (int side = 0; side < 2; ++side) {
      FlatBox grown = split_.box[side];
      grow(grown.at, reference.lower);
      const float cost =
          area_(grown) * side_count_[side] + side_area_[1 - side] * (side_count_[1 - side] - 1);
      if (cost <= least) {
        least = cost;
        best = side;
      }
    }
    return best;
  }

  void cut(const SahReference& reference, Parts& parts) const {
    Box box[2];
    split_box(Corners(cutting_.mesh, reference.primitive, cutting_.frame), reference.box(),
              split_.axis, plane_, box[0], box[1]);
    for (int side = 0; side < 2; ++side) {
      // A box is inside out where the triangle has no part on that side.
      for (int k = 0; k < 3; ++k) parts.is_on[side] &= box[side].lower[k] <= box[side].upper[k];
      parts.part[side] = SahReference::part(box[side], reference.primitive);
    }
  }

  const Split& split_;
  const Cutting& cutting_;
  Areas area_;
  float plane_;
  float side_area_[2];
  float side_count_[2];
};

void count_parts(const SahReference* references, uint64_t count, const SahNode& node,
                 const Split& split, const Cutting& cutting, uint64_t placed[2]) {
  const Cutter cutter(node, split, cutting);
  placed[0] = placed[1] = 0;
  Parts parts;
  for (uint64_t i = 0; i < count; ++i) {
    cutter(references[i], parts);
    for (int side = 0; side < 2; ++side) placed[side] += parts.is_on[side] ? 1 : 0;
  }
}

void partition_planes(const SahReference* references, uint64_t count, const SahNode& node,
                      const Split& split, const Cutting& cutting, SahReference* left,
                      SahReference* right, SahExtent side[2]) {
  const Cutter cutter(node, split, cutting);
  SahReference* to[2] = {left, right};
  Parts parts;
  for (uint64_t i = 0; i < count; ++i) {
    cutter(references[i], parts);
    for (int k = 0; k < 2; ++k) {
      if (!parts.is_on[k]) continue;
      bound(&parts.part[k], 1, side[k]);
      copy(parts.part[k], *to[k]++);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
