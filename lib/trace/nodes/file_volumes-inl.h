// SPDX-License-Identifier: Apache-2.0
// The volumes of the file's nodes: three slabs per child, along directions that the children of a
// node mostly share.
#if defined(SOBB_TRACE_NODES_FILE_VOLUMES_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_NODES_FILE_VOLUMES_INL_H
#undef SOBB_TRACE_NODES_FILE_VOLUMES_INL_H
#else
#define SOBB_TRACE_NODES_FILE_VOLUMES_INL_H
#endif

#include <hwy/highway.h>

#include <type_traits>

#include "format/layout.h"
#include "trace/nodes/frame_ray-inl.h"
#include "trace/nodes/node_volumes-inl.h"
#include "trace/nodes/slab_clip-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// kFrame: all nodes are along the frame, and no kernel need look.
template <int W, bool kFrame>
struct FileVolumes {
  static constexpr int kWidth = W;
  static constexpr bool kFrameOnly = kFrame;
  using Node = sobb::Node<W>;
  using Ray = std::conditional_t<kFrame, FrameRay<W>, RayTable>;

  static HWY_INLINE bool on_frame(const Node& node) requires(!kFrame) {
    return sobb::on_frame(node);
  }

  template <class V = hn::Vec<ChildFloats<W>>>
  static HWY_INLINE void clip(const typename FrameRay<W>::InRegisters& ray, const Node& node,
                              size_t first, V& near, V& far) {
    ray.clip(node, first, near, far);
  }

  template <class V = hn::Vec<ChildFloats<W>>>
  static HWY_INLINE void clip(const RayTable& table, const Node& node, size_t first, V& near,
                              V& far) {
    const bool shared = (node.meta[0] & kSharedBit) != 0;
    if (sobb::on_frame(node)) {
      // The places in the table are constants, so that its loads need not wait for the node.
      for (uint32_t k = 0; k < 3; ++k) clip_shared<W>(table, node.slab[k], k, first, near, far);
      return;
    }
    if (shared) {
      for (int j = 0; j < 3; ++j) {
        clip_shared<W>(table, node.slab[j], basis_direction(node.basis[0], j), first, near, far);
      }
      return;
    }
    for (int j = 0; j < 3; ++j) {
      clip_own<W>(table, node.slab[j], node.basis + first, j, first, near, far);
    }
  }
};

static_assert(NodeVolumes<FileVolumes<4, true>> && NodeVolumes<FileVolumes<8, false>>);

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
