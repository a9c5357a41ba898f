// SPDX-License-Identifier: Apache-2.0
// Rays of a stream against the children of a node: what is the same for all rays is made once a
// visit. There are no tables: the coefficients of directions off the frame are made where they are
// needed. Included once for each Highway target.
#if defined(SOBB_TRACE_BATCH_NODE_TESTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_BATCH_NODE_TESTS_INL_H
#undef SOBB_TRACE_BATCH_NODE_TESTS_INL_H
#else
#define SOBB_TRACE_BATCH_NODE_TESTS_INL_H
#endif

#include <hwy/highway.h>

#include "trace/batch/batch_rays-inl.h"
#include "trace/batch/ray_bundle-inl.h"
#include "trace/nodes/slab_clip-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// As many lanes as a vector of children has, of entries.
template <int W>
using ChildEntries = hn::RebindToUnsigned<ChildFloats<W>>;

// A ray's interval, and what it leaves of it in children.
template <int W>
struct ChildIntervals {
  using V = hn::Vec<ChildFloats<W>>;
  V near;
  V far;

  HWY_INLINE explicit ChildIntervals(const SlabRay& ray)
      : near(hn::Set(ChildFloats<W>(), ray.tmin)), far(hn::Set(ChildFloats<W>(), ray.limit)) {}
};

// Each of these is a test of a node, by
//   alone(ray, first)   the interval of one ray in as many children as a vector has lanes
//   of(group)           what rays of a group have to do with all children
//   clip(of_group, child, near, far)   clips their intervals with a child's
//   kFewest             rays from which on a list pays; with bases of the children's own a group is
//                       to be full, since of each child its coefficients are made

// Along the first three directions, for rays of one octant.
template <int W>
struct FrameNode {
  static constexpr uint32_t kFewest = 4;
  using V = RayGroup::V;
  const float* near_plane[3];
  const float* far_plane[3];

  HWY_INLINE FrameNode(const Node<W>& node, uint32_t octant) {
    for (int j = 0; j < 3; ++j) {
      near_plane[j] = node.slab[j][octant >> j & 1];
      far_plane[j] = node.slab[j][1 - (octant >> j & 1)];
    }
  }

  HWY_INLINE ChildIntervals<W> alone(const SlabRay& ray, size_t first) const {
    const ChildFloats<W> d;
    ChildIntervals<W> of(ray);
    for (int j = 0; j < 3; ++j) {
      const auto r = hn::Set(d, ray.reciprocal[j]);
      of.near = hn::Max(of.near,
                        hn::MulAdd(hn::Load(d, near_plane[j] + first), r, hn::Set(d, ray.near[j])));
      of.far =
          hn::Min(of.far, hn::MulAdd(hn::Load(d, far_plane[j] + first), r, hn::Set(d, ray.far[j])));
    }
    return of;
  }

  struct Group {
    SlabCoefficients<V> along[3];
  };
  HWY_INLINE Group of(const RayGroup& group) const {
    V far[3];
    V unused;
    group.load_rows(&SlabRay::far, far, unused);
    Group of;
    for (int j = 0; j < 3; ++j) of.along[j] = {group.reciprocal[j], group.near[j], far[j]};
    return of;
  }

  HWY_INLINE void clip(const Group& of, uint32_t child, V& near, V& far) const {
    const RayFloats d;
    for (int j = 0; j < 3; ++j) {
      const auto& c = of.along[j];
      near = hn::Max(near, hn::MulAdd(hn::Set(d, near_plane[j][child]), c.reciprocal, c.near));
      far = hn::Min(far, hn::MulAdd(hn::Set(d, far_plane[j][child]), c.reciprocal, c.far));
    }
  }
};

// Rays of a group as the coefficients of other directions are made of them.
struct GroupRays {
  using V = RayGroup::V;
  V origin[3];
  V direction[3];
  V error;

  HWY_INLINE explicit GroupRays(const RayGroup& group) {
    V scale;
    group.load_rows(&SlabRay::origin, origin, scale);
    group.load_rows(&SlabRay::direction, direction, error);
  }

  HWY_INLINE SlabCoefficients<V> along(float x, float y, float z) const {
    const RayFloats d;
    return slab_coefficients(d, hn::Set(d, x), hn::Set(d, y), hn::Set(d, z), origin[0], origin[1],
                             origin[2], direction[0], direction[1], direction[2], error);
  }
};

// Clips with a slab of one child, whose near plane is the lower one for rays that rise.
HWY_INLINE void clip_child(const SlabCoefficients<RayGroup::V>& c, float lower, float upper,
                           RayGroup::V& near, RayGroup::V& far) {
  const RayFloats d;
  const auto falls = hn::MaskFromVec(c.reciprocal);  // AVX2 and SSE4 read the sign bit alone
  const auto low = hn::Set(d, lower);
  const auto high = hn::Set(d, upper);
  near = hn::Max(near, hn::MulAdd(hn::IfThenElse(falls, high, low), c.reciprocal, c.near));
  far = hn::Min(far, hn::MulAdd(hn::IfThenElse(falls, low, high), c.reciprocal, c.far));
}

// Along three directions that the children share.
template <int W>
struct SharedNode {
  static constexpr uint32_t kFewest = 4;
  using V = RayGroup::V;
  const Node<W>& node;
  alignas(16) float normal[3][4];  // by axis, then direction

  HWY_INLINE SharedNode(const TraceScene& scene, const Node<W>& node) : node(node) {
    for (int j = 0; j < 3; ++j) {
      const uint32_t k = basis_direction(node.basis[0], j);
      normal[0][j] = scene.directions.x[k];
      normal[1][j] = scene.directions.y[k];
      normal[2][j] = scene.directions.z[k];
    }
    for (auto& axis : normal) axis[3] = 0;
  }

  HWY_INLINE ChildIntervals<W> alone(const SlabRay& ray, size_t first) const {
    const ChildFloats<W> d;
    const hn::CappedTag<float, 4> d4;
    const auto c = slab_coefficients(d4, hn::Load(d4, normal[0]), hn::Load(d4, normal[1]),
                                     hn::Load(d4, normal[2]), hn::Set(d4, ray.origin[0]),
                                     hn::Set(d4, ray.origin[1]), hn::Set(d4, ray.origin[2]),
                                     hn::Set(d4, ray.direction[0]), hn::Set(d4, ray.direction[1]),
                                     hn::Set(d4, ray.direction[2]), hn::Set(d4, ray.error));
    alignas(16) float reciprocal[4];
    alignas(16) float nears[4];
    alignas(16) float fars[4];
    hn::Store(c.reciprocal, d4, reciprocal);
    hn::Store(c.near, d4, nears);
    hn::Store(c.far, d4, fars);
    ChildIntervals<W> of(ray);
    for (int j = 0; j < 3; ++j) {
      clip_slab<W>({hn::Set(d, reciprocal[j]), hn::Set(d, nears[j]), hn::Set(d, fars[j])},
                   node.slab[j], first, of.near, of.far);
    }
    return of;
  }

  struct Group {
    SlabCoefficients<V> along[3];
  };
  HWY_INLINE Group of(const RayGroup& group) const {
    const GroupRays rays(group);
    Group of;
    for (int j = 0; j < 3; ++j) of.along[j] = rays.along(normal[0][j], normal[1][j], normal[2][j]);
    return of;
  }

  HWY_INLINE void clip(const Group& of, uint32_t child, V& near, V& far) const {
    for (int j = 0; j < 3; ++j) {
      clip_child(of.along[j], node.slab[j][0][child], node.slab[j][1][child], near, far);
    }
  }
};

// Along three directions of each child's own.
template <int W>
struct OwnNode {
  static constexpr uint32_t kFewest = 8;
  using V = RayGroup::V;
  const Node<W>& node;
  alignas(64) float normal[3][3][W];  // by slab, then axis

  HWY_INLINE OwnNode(const TraceScene& scene, const Node<W>& node) : node(node) {
    for (int i = 0; i < W; ++i) {
      for (int j = 0; j < 3; ++j) {
        const uint32_t k = basis_direction(node.basis[i], j);
        normal[j][0][i] = scene.directions.x[k];
        normal[j][1][i] = scene.directions.y[k];
        normal[j][2][i] = scene.directions.z[k];
      }
    }
  }

  HWY_INLINE ChildIntervals<W> alone(const SlabRay& ray, size_t first) const {
    const ChildFloats<W> d;
    ChildIntervals<W> of(ray);
    for (int j = 0; j < 3; ++j) {
      const auto c = slab_coefficients(
          d, hn::Load(d, normal[j][0] + first), hn::Load(d, normal[j][1] + first),
          hn::Load(d, normal[j][2] + first), hn::Set(d, ray.origin[0]), hn::Set(d, ray.origin[1]),
          hn::Set(d, ray.origin[2]), hn::Set(d, ray.direction[0]), hn::Set(d, ray.direction[1]),
          hn::Set(d, ray.direction[2]), hn::Set(d, ray.error));
      clip_slab<W>(c, node.slab[j], first, of.near, of.far);
    }
    return of;
  }

  HWY_INLINE GroupRays of(const RayGroup& group) const { return GroupRays(group); }

  HWY_INLINE void clip(const GroupRays& rays, uint32_t child, V& near, V& far) const {
    for (int j = 0; j < 3; ++j) {
      const auto c = rays.along(normal[j][0][child], normal[j][1][child], normal[j][2][child]);
      clip_child(c, node.slab[j][0][child], node.slab[j][1][child], near, far);
    }
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
