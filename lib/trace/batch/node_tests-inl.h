// SPDX-License-Identifier: Apache-2.0
// Rays of a batch against the children of a node. What is the same for all rays is made once per
// visit. There are no tables of directions: the coefficients of those off the frame are made where
// they are needed.
//
// Each kind of node has a test with
//   kFewest             the rays from which on a list pays
//   alone(ray, first)   the interval of one ray in as many children as a vector has lanes
//   of(bundle)          what the rays of a bundle have to do with all children
//   clip(of_bundle, child, near, far)   clips their intervals with a child's
#if defined(SOBB_TRACE_BATCH_NODE_TESTS_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_BATCH_NODE_TESTS_INL_H
#undef SOBB_TRACE_BATCH_NODE_TESTS_INL_H
#else
#define SOBB_TRACE_BATCH_NODE_TESTS_INL_H
#endif

#include <hwy/highway.h>

#include "trace/batch/ray_bundle-inl.h"
#include "trace/nodes/frame_clip-inl.h"
#include "trace/nodes/slab_clip-inl.h"
#include "trace/trace.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// A ray's interval, and what it leaves of it in children.
template <int W>
struct ChildIntervals {
  using V = hn::Vec<ChildFloats<W>>;
  V near;
  V far;

  HWY_INLINE explicit ChildIntervals(const SlabRay& ray)
      : near(hn::Set(ChildFloats<W>(), ray.tmin)), far(hn::Set(ChildFloats<W>(), ray.limit)) {}
};

// A bundle's coefficients along three directions that the children share.
struct SharedCoefficients {
  SlabCoefficients<RayBundle::V> along[3];
};

// A node along the frame, for rays of one octant.
template <int W>
class FrameNode {
  using V = RayBundle::V;
  using Planes = FramePlanes<W>;

 public:
  static constexpr uint32_t kFewest = 4;

  HWY_INLINE FrameNode(const Node<W>& node, uint32_t octant) : node_(node) {
    for (uint32_t j = 0; j < 3; ++j) {
      const uint32_t falls = octant >> j & 1;
      near_[j] = node.slab[j][falls];
      far_[j] = node.slab[j][1 - falls];
      near_plane_[j] = Planes::near(j, falls);
    }
  }

  HWY_INLINE ChildIntervals<W> alone(const SlabRay& ray, size_t first) const {
    ChildIntervals<W> of(ray);
    clip_frame<W>(ray, near_plane_, node_, first, of.near, of.far);
    return of;
  }

  HWY_INLINE SharedCoefficients of(const RayBundle& bundle) const {
    V far[3];
    V unused;
    bundle.load(&SlabRay::far, far, unused);
    SharedCoefficients of;
    for (int j = 0; j < 3; ++j) of.along[j] = {bundle.reciprocal[j], bundle.near[j], far[j]};
    return of;
  }

  HWY_INLINE void clip(const SharedCoefficients& of, uint32_t child, V& near, V& far) const {
    const RayFloats d;
    for (int j = 0; j < 3; ++j) {
      clip_known(of.along[j], hn::Set(d, near_[j][child]), hn::Set(d, far_[j][child]), near, far);
    }
  }

 private:
  const Node<W>& node_;
  const float* near_[3];
  const float* far_[3];
  size_t near_plane_[3];
};

// The rays of a bundle, as the coefficients of directions off the frame are made from them.
struct BundleRays {
  using V = RayBundle::V;
  V origin[3];
  V direction[3];
  V error;

  HWY_INLINE explicit BundleRays(const RayBundle& bundle) {
    V scale;
    bundle.load(&SlabRay::origin, origin, scale);
    bundle.load(&SlabRay::direction, direction, error);
  }

  HWY_INLINE SlabCoefficients<V> along(float x, float y, float z) const {
    const RayFloats d;
    return slab_coefficients(d, hn::Set(d, x), hn::Set(d, y), hn::Set(d, z), origin[0], origin[1],
                             origin[2], direction[0], direction[1], direction[2], error);
  }
};

// Clips a bundle with a slab of one child.
HWY_INLINE void clip_child(const SlabCoefficients<RayBundle::V>& c, float lower, float upper,
                           RayBundle::V& near, RayBundle::V& far) {
  const RayFloats d;
  clip_planes(c, hn::Set(d, lower), hn::Set(d, upper), near, far);
}

// A node along three directions that its children share.
template <int W>
class SharedNode {
  using V = RayBundle::V;

 public:
  static constexpr uint32_t kFewest = 4;

  HWY_INLINE SharedNode(const TraceScene& scene, const Node<W>& node) : node_(node) {
    for (int j = 0; j < 3; ++j) {
      const uint32_t k = basis_direction(node.basis[0], j);
      normal_[0][j] = scene.directions.x[k];
      normal_[1][j] = scene.directions.y[k];
      normal_[2][j] = scene.directions.z[k];
    }
    for (auto& axis : normal_) axis[3] = 0;
  }

  HWY_INLINE ChildIntervals<W> alone(const SlabRay& ray, size_t first) const {
    const ChildFloats<W> d;
    alignas(16) float reciprocal[4];
    alignas(16) float nears[4];
    alignas(16) float fars[4];
    three_slab_coefficients(normal_[0], normal_[1], normal_[2], ray, reciprocal, nears, fars);
    ChildIntervals<W> of(ray);
    for (int j = 0; j < 3; ++j) {
      clip_slab<W>({hn::Set(d, reciprocal[j]), hn::Set(d, nears[j]), hn::Set(d, fars[j])},
                   node_.slab[j], first, of.near, of.far);
    }
    return of;
  }

  HWY_INLINE SharedCoefficients of(const RayBundle& bundle) const {
    const BundleRays rays(bundle);
    SharedCoefficients of;
    for (int j = 0; j < 3; ++j) {
      of.along[j] = rays.along(normal_[0][j], normal_[1][j], normal_[2][j]);
    }
    return of;
  }

  HWY_INLINE void clip(const SharedCoefficients& of, uint32_t child, V& near, V& far) const {
    for (int j = 0; j < 3; ++j) {
      clip_child(of.along[j], node_.slab[j][0][child], node_.slab[j][1][child], near, far);
    }
  }

 private:
  const Node<W>& node_;
  alignas(16) float normal_[3][4];  // by axis, then direction
};

// A node along three directions of each child's own. A bundle is to be full, since the coefficients
// are made for each child.
template <int W>
class OwnNode {
  using V = RayBundle::V;

 public:
  static constexpr uint32_t kFewest = 8;

  HWY_INLINE OwnNode(const TraceScene& scene, const Node<W>& node) : node_(node) {
    for (int i = 0; i < W; ++i) {
      for (int j = 0; j < 3; ++j) {
        const uint32_t k = basis_direction(node.basis[i], j);
        normal_[j][0][i] = scene.directions.x[k];
        normal_[j][1][i] = scene.directions.y[k];
        normal_[j][2][i] = scene.directions.z[k];
      }
    }
  }

  HWY_INLINE ChildIntervals<W> alone(const SlabRay& ray, size_t first) const {
    const ChildFloats<W> d;
    ChildIntervals<W> of(ray);
    for (int j = 0; j < 3; ++j) {
      const auto& normal = normal_[j];
      const auto c =
          slab_coefficients(d, hn::Load(d, normal[0] + first), hn::Load(d, normal[1] + first),
                            hn::Load(d, normal[2] + first), ray);
      clip_slab<W>(c, node_.slab[j], first, of.near, of.far);
    }
    return of;
  }

  HWY_INLINE BundleRays of(const RayBundle& bundle) const { return BundleRays(bundle); }

  HWY_INLINE void clip(const BundleRays& rays, uint32_t child, V& near, V& far) const {
    for (int j = 0; j < 3; ++j) {
      const auto& normal = normal_[j];
      clip_child(rays.along(normal[0][child], normal[1][child], normal[2][child]),
                 node_.slab[j][0][child], node_.slab[j][1][child], near, far);
    }
  }

 private:
  const Node<W>& node_;
  alignas(64) float normal_[3][3][W];  // by slab, then axis
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
