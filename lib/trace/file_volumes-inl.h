// SPDX-License-Identifier: Apache-2.0
// The volumes of the file's nodes: three slabs a child, along directions that a node's children
// mostly share. Included once for each Highway target.
#if defined(SOBB_TRACE_FILE_VOLUMES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_FILE_VOLUMES_INL_H
#undef SOBB_TRACE_FILE_VOLUMES_INL_H
#else
#define SOBB_TRACE_FILE_VOLUMES_INL_H
#endif

#include <hwy/highway.h>

#include "format/layout.h"
#include "trace/slab_clip-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// kAxes: the hierarchy is of AABBs, its directions are 0, 1, 2 everywhere.
template <int W, bool kAxes>
struct FileVolumes {
  static constexpr int kWidth = W;
  using Node = sobb::Node<W>;
  using Ray = RayTable;

  template <class V = hn::Vec<ChildFloats<W>>>
  static HWY_INLINE void clip(const RayTable& table, const Node& node, size_t first, V& near,
                              V& far) {
    if (kAxes || (node.meta[0] & kSharedBit) != 0) {
      const uint32_t basis = kAxes ? kAxesBasis : node.basis[0];
      for (int j = 0; j < 3; ++j) {
        clip_shared<W>(table, node.slab[j], basis_direction(basis, j), first, near, far);
      }
      return;
    }
    for (int j = 0; j < 3; ++j) {
      clip_own<W>(table, node.slab[j], node.basis + first, j, first, near, far);
    }
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
