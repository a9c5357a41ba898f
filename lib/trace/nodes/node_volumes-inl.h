// SPDX-License-Identifier: Apache-2.0
// What a class must offer for a traversal to go through its nodes: the children's volumes, and the
// ray's side of their tests.
//
// The room nodes/ is a ray against the children of a node: slabs clip its interval
// (slab_clip-inl.h), with one set of coefficients per direction of the table (ray_table-inl.h) or,
// along the frame, in registers (frame_clip-inl.h, frame_ray-inl.h); file_volumes-inl.h has the
// file's nodes, stack_key.h, child_order.h and prefetch-inl.h what every traversal does with the
// children met. It knows ray/.
#if defined(SOBB_TRACE_NODES_NODE_VOLUMES_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_NODES_NODE_VOLUMES_INL_H
#undef SOBB_TRACE_NODES_NODE_VOLUMES_INL_H
#else
#define SOBB_TRACE_NODES_NODE_VOLUMES_INL_H
#endif

#include <hwy/highway.h>

#include <concepts>
#include <type_traits>

#include "trace/nodes/frame_ray-inl.h"
#include "trace/nodes/slab_clip-inl.h"
#include "trace/ray/scaled_ray.h"
#include "trace/trace.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// A ray that has a register copy for the inner loop is tested as that, others as they are.
template <class Ray>
HWY_INLINE const Ray& in_registers(const Ray& ray) {
  return ray;
}
template <class Ray>
requires requires { typename Ray::InRegisters; }
HWY_INLINE typename Ray::InRegisters in_registers(const Ray& ray) {
  return typename Ray::InRegisters(ray);
}

// kWidth: the most children per node.
// Node: with reference[kWidth] and meta[kWidth] as format/layout.h has them.
// Ray: the ray's side of the tests, made of a TraceScene and a ScaledRay.
// clip(ray, node, first, near, far): clips the intervals of as many children as a vector has lanes,
//   from child `first` on.
template <class Volumes>
concept NodeVolumes = std::convertible_to<decltype(Volumes::kWidth), int> &&
    std::constructible_from<typename Volumes::Ray, const TraceScene&, const ScaledRay&> &&
    requires(const typename Volumes::Ray& ray, const typename Volumes::Node& node,
             hn::Vec<ChildFloats<Volumes::kWidth>>& interval) {
  { node.reference[0] } -> std::convertible_to<uint32_t>;
  { node.meta[0] } -> std::convertible_to<uint16_t>;
  Volumes::clip(in_registers(ray), node, size_t{0}, interval, interval);
};

// Some volumes have nodes along the frame among others, which on_frame(node) tells, and for which
// clip() can do with a FrameRay.
template <class Volumes>
concept HasFrameNodes = requires(const typename Volumes::Node& node) {
  Volumes::on_frame(node);
};

// Returns whether a ray's side is enough for a node.
template <class Volumes, class Ray>
HWY_INLINE bool covers(const typename Volumes::Node& node) {
  if constexpr (HasFrameNodes<Volumes> && std::is_same_v<Ray, FrameRay<Volumes::kWidth>>) {
    return Volumes::on_frame(node);
  }
  return true;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
