// SPDX-License-Identifier: Apache-2.0
// One ray before nodes along the frame, the table's first three directions: its coefficients are
// known before the node is, so that a traversal of such nodes keeps them in registers.
#if defined(SOBB_TRACE_NODES_FRAME_RAY_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_NODES_FRAME_RAY_INL_H
#undef SOBB_TRACE_NODES_FRAME_RAY_INL_H
#else
#define SOBB_TRACE_NODES_FRAME_RAY_INL_H
#endif

#include <hwy/highway.h>

#include "format/layout.h"
#include "trace/nodes/frame_clip-inl.h"
#include "trace/ray/scaled_ray.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

template <int W>
class FrameRay {
  using Planes = FramePlanes<W>;

 public:
  HWY_INLINE FrameRay(const TraceScene& scene, const ScaledRay& ray) {
    const DirectionTable& directions = scene.directions;
    three_slab_coefficients(directions.x, directions.y, directions.z, ray, reciprocal_, near_,
                            far_);
    for (size_t j = 0; j < 3; ++j) {
      near_plane_[j] = Planes::near(j, falls_along(reciprocal_[j]));
      far_plane_[j] = Planes::other(near_plane_[j]);
    }
  }

  // A register copy of the ray for the inner loop: its members are indexed by constants only.
  class InRegisters {
   public:
    using V = hn::Vec<ChildFloats<W>>;

    HWY_INLINE explicit InRegisters(const FrameRay& ray) {
      const ChildFloats<W> d;
      for (int j = 0; j < 3; ++j) {
        coefficients_[j] = {hn::Set(d, ray.reciprocal_[j]), hn::Set(d, ray.near_[j]),
                            hn::Set(d, ray.far_[j])};
        near_plane_[j] = ray.near_plane_[j];
        far_plane_[j] = ray.far_plane_[j];
      }
    }

    HWY_INLINE void clip(const Node<W>& node, size_t first, V& near, V& far) const {
      const auto near_at = [&](int j) HWY_ATTR {
        return plane_distance(Planes::load(node, near_plane_[j], first),
                              coefficients_[j].reciprocal, coefficients_[j].near);
      };
      const auto far_at = [&](int j) HWY_ATTR {
        return plane_distance(Planes::load(node, far_plane_[j], first), coefficients_[j].reciprocal,
                              coefficients_[j].far);
      };
      clip_frame_tree(near_at, far_at, near, far);
    }

   private:
    SlabCoefficients<V> coefficients_[3];
    size_t near_plane_[3];
    size_t far_plane_[3];
  };

 private:
  alignas(16) float reciprocal_[4];
  alignas(16) float near_[4];
  alignas(16) float far_[4];
  size_t near_plane_[3];  // in bytes from a node's first plane
  size_t far_plane_[3];
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
