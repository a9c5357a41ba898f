// SPDX-License-Identifier: Apache-2.0
// A ray's intervals in the children of a node along the frame, the table's first three directions.
// Which planes are the near ones is known before the node is, by the ray's octant.
#if defined(SOBB_TRACE_NODES_FRAME_CLIP_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_NODES_FRAME_CLIP_INL_H
#undef SOBB_TRACE_NODES_FRAME_CLIP_INL_H
#else
#define SOBB_TRACE_NODES_FRAME_CLIP_INL_H
#endif

#include <hwy/highway.h>

#include "format/layout.h"
#include "trace/nodes/slab_clip-inl.h"
#include "trace/ray/slab_ray.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// FramePlanes tells where the planes of the j-th slab are, in bytes from a node's first plane.
template <int W>
struct FramePlanes {
  static constexpr size_t kPlane = sizeof(float) * W;  // from a lower plane to its upper one

  static constexpr size_t near(size_t j, uint32_t falls) { return (2 * j + falls) * kPlane; }
  static constexpr size_t other(size_t plane) { return plane ^ kPlane; }

  // The planes of as many children as a vector has lanes, from child `first` on.
  static HWY_INLINE hn::Vec<ChildFloats<W>> load(const Node<W>& node, size_t plane, size_t first) {
    const auto* bytes = reinterpret_cast<const uint8_t*>(node.slab) + first * sizeof(float);
    return hn::Load(ChildFloats<W>(), reinterpret_cast<const float*>(bytes + plane));
  }
};

// There are two forms of the same maximum and minimum. `near_at(j)` and `far_at(j)` are the
// distances of the j-th slab's planes.

// The chain is for kernels whose rays take turns, which nothing keeps waiting. (Waves with the
// tree: city 0.95, motorbike 0.99, crown 1.02, chopper 0.97 of the speed.)
template <class V, class NearAt, class FarAt>
HWY_INLINE void clip_frame_chain(const NearAt& near_at, const FarAt& far_at, V& near, V& far) {
  for (int j = 0; j < 3; ++j) {
    near = hn::Max(near, near_at(j));
    far = hn::Min(far, far_at(j));
  }
}

// The tree is for the kernel of one ray, which waits for it at every node.
template <class V, class NearAt, class FarAt>
HWY_INLINE void clip_frame_tree(const NearAt& near_at, const FarAt& far_at, V& near, V& far) {
  near = hn::Max(hn::Max(near_at(0), near_at(1)), hn::Max(near_at(2), near));
  far = hn::Min(hn::Min(far_at(0), far_at(1)), hn::Min(far_at(2), far));
}

// The chain for a ray whose coefficients lie in memory; `near_planes` has a FramePlanes::near() for
// each slab.
template <int W, class Offset>
HWY_INLINE void clip_frame(const SlabRay& ray, const Offset (&near_planes)[3], const Node<W>& node,
                           size_t first, hn::Vec<ChildFloats<W>>& near,
                           hn::Vec<ChildFloats<W>>& far) {
  using Planes = FramePlanes<W>;
  const ChildFloats<W> d;
  const auto near_at = [&](int j) HWY_ATTR {
    return plane_distance(Planes::load(node, near_planes[j], first), hn::Set(d, ray.reciprocal[j]),
                          hn::Set(d, ray.near[j]));
  };
  const auto far_at = [&](int j) HWY_ATTR {
    return plane_distance(Planes::load(node, Planes::other(near_planes[j]), first),
                          hn::Set(d, ray.reciprocal[j]), hn::Set(d, ray.far[j]));
  };
  clip_frame_chain(near_at, far_at, near, far);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
