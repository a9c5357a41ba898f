// SPDX-License-Identifier: Apache-2.0
// A ray's side of the slab tests of nodes along the frame, the table's first three directions:
// known before the node is, so that a traversal of such nodes keeps it in registers, and where in a
// node the near planes are. Included once for each Highway target.
#if defined(SOBB_TRACE_NODES_FRAME_RAY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_NODES_FRAME_RAY_INL_H
#undef SOBB_TRACE_NODES_FRAME_RAY_INL_H
#else
#define SOBB_TRACE_NODES_FRAME_RAY_INL_H
#endif

#include <hwy/highway.h>

#include <bit>

#include "format/layout.h"
#include "trace/nodes/ray_table-inl.h"
#include "trace/nodes/slab_clip-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

template <int W>
class FrameRay {
 public:
  HWY_INLINE FrameRay(const TraceScene& scene, const ScaledRay& ray) {
    const hn::CappedTag<float, 4> d;
    const DirectionTable& directions = scene.directions;
    const auto c = slab_coefficients(d, hn::Load(d, directions.x), hn::Load(d, directions.y),
                                     hn::Load(d, directions.z), hn::Set(d, ray.origin[0]),
                                     hn::Set(d, ray.origin[1]), hn::Set(d, ray.origin[2]),
                                     hn::Set(d, ray.direction[0]), hn::Set(d, ray.direction[1]),
                                     hn::Set(d, ray.direction[2]), hn::Set(d, ray.error));
    hn::Store(c.reciprocal, d, reciprocal_);
    hn::Store(c.near, d, near_);
    hn::Store(c.far, d, far_);
    for (size_t j = 0; j < 3; ++j) {
      const size_t falls = std::bit_cast<uint32_t>(reciprocal_[j]) >> 31;
      near_plane_[j] = (2 * j + falls) * kPlane;
      far_plane_[j] = near_plane_[j] ^ kPlane;
    }
  }

  // The same for the length of a loop. Its members are never indexed but by constants.
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
      const ChildFloats<W> d;
      const auto* planes = reinterpret_cast<const uint8_t*>(node.slab) + first * sizeof(float);
      const auto load = [&](size_t at) HWY_ATTR {
        return hn::Load(d, reinterpret_cast<const float*>(planes + at));
      };
      const auto near_at = [&](int j) HWY_ATTR {
        return hn::MulAdd(load(near_plane_[j]), coefficients_[j].reciprocal, coefficients_[j].near);
      };
      const auto far_at = [&](int j) HWY_ATTR {
        return hn::MulAdd(load(far_plane_[j]), coefficients_[j].reciprocal, coefficients_[j].far);
      };
      near = hn::Max(hn::Max(near_at(0), near_at(1)), hn::Max(near_at(2), near));
      far = hn::Min(hn::Min(far_at(0), far_at(1)), hn::Min(far_at(2), far));
    }

   private:
    SlabCoefficients<V> coefficients_[3];
    size_t near_plane_[3];
    size_t far_plane_[3];
  };

 private:
  static constexpr size_t kPlane = sizeof(float) * W;  // from a slab's lower plane to its upper one

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
