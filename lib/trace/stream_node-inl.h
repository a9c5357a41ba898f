// SPDX-License-Identifier: Apache-2.0
// A ray of a stream against the children of a node: what is the same for all rays is made once a
// visit. There are no tables: the coefficients of directions off the frame are made where they are
// needed. Included once for each Highway target.
#if defined(SOBB_TRACE_STREAM_NODE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_STREAM_NODE_INL_H
#undef SOBB_TRACE_STREAM_NODE_INL_H
#else
#define SOBB_TRACE_STREAM_NODE_INL_H
#endif

#include <hwy/highway.h>

#include "trace/slab_clip-inl.h"
#include "trace/stream_batch-inl.h"
#include "trace/stream_lists-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Each of these is called with a ray and the first of as many children as a vector has lanes, and
// returns the ray's entries with them.

// Along the first three directions, for rays of one octant.
template <int W>
struct FrameNode {
  const StreamBatch& batch;
  const float* near_plane[3];
  const float* far_plane[3];

  HWY_INLINE FrameNode(const StreamBatch& batch, const Node<W>& node, uint32_t octant)
      : batch(batch) {
    for (int j = 0; j < 3; ++j) {
      near_plane[j] = node.slab[j][octant >> j & 1];
      far_plane[j] = node.slab[j][1 - (octant >> j & 1)];
    }
  }

  HWY_INLINE hn::Vec<ChildEntries<W>> operator()(uint32_t index, size_t first) const {
    const ChildFloats<W> d;
    const SlabRay& ray = batch.ray[index];
    auto near = hn::Set(d, ray.tmin);
    auto far = hn::Set(d, ray.limit);
    for (int j = 0; j < 3; ++j) {
      const auto r = hn::Set(d, ray.reciprocal[j]);
      near =
          hn::Max(near, hn::MulAdd(hn::Load(d, near_plane[j] + first), r, hn::Set(d, ray.near[j])));
      far = hn::Min(far, hn::MulAdd(hn::Load(d, far_plane[j] + first), r, hn::Set(d, ray.far[j])));
    }
    return make_entries<W>(index, near, far);
  }
};

// Along three directions that the children share.
template <int W>
struct SharedNode {
  const StreamBatch& batch;
  const Node<W>& node;
  alignas(16) float normal[3][4];  // by axis, then direction

  HWY_INLINE SharedNode(const TraceScene& scene, const StreamBatch& batch, const Node<W>& node)
      : batch(batch), node(node) {
    for (int j = 0; j < 3; ++j) {
      const uint32_t k = basis_direction(node.basis[0], j);
      normal[0][j] = scene.directions.x[k];
      normal[1][j] = scene.directions.y[k];
      normal[2][j] = scene.directions.z[k];
    }
    for (auto& axis : normal) axis[3] = 0;
  }

  HWY_INLINE hn::Vec<ChildEntries<W>> operator()(uint32_t index, size_t first) const {
    const ChildFloats<W> d;
    const hn::CappedTag<float, 4> d4;
    const SlabRay& ray = batch.ray[index];
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
    auto near = hn::Set(d, ray.tmin);
    auto far = hn::Set(d, ray.limit);
    for (int j = 0; j < 3; ++j) {
      clip_slab<W>({hn::Set(d, reciprocal[j]), hn::Set(d, nears[j]), hn::Set(d, fars[j])},
                   node.slab[j], first, near, far);
    }
    return make_entries<W>(index, near, far);
  }
};

// Along three directions of each child's own.
template <int W>
struct OwnNode {
  const StreamBatch& batch;
  const Node<W>& node;
  alignas(64) float normal[3][3][W];  // by slab, then axis

  HWY_INLINE OwnNode(const TraceScene& scene, const StreamBatch& batch, const Node<W>& node)
      : batch(batch), node(node) {
    for (int i = 0; i < W; ++i) {
      for (int j = 0; j < 3; ++j) {
        const uint32_t k = basis_direction(node.basis[i], j);
        normal[j][0][i] = scene.directions.x[k];
        normal[j][1][i] = scene.directions.y[k];
        normal[j][2][i] = scene.directions.z[k];
      }
    }
  }

  HWY_INLINE hn::Vec<ChildEntries<W>> operator()(uint32_t index, size_t first) const {
    const ChildFloats<W> d;
    const SlabRay& ray = batch.ray[index];
    auto near = hn::Set(d, ray.tmin);
    auto far = hn::Set(d, ray.limit);
    for (int j = 0; j < 3; ++j) {
      const auto c = slab_coefficients(
          d, hn::Load(d, normal[j][0] + first), hn::Load(d, normal[j][1] + first),
          hn::Load(d, normal[j][2] + first), hn::Set(d, ray.origin[0]), hn::Set(d, ray.origin[1]),
          hn::Set(d, ray.origin[2]), hn::Set(d, ray.direction[0]), hn::Set(d, ray.direction[1]),
          hn::Set(d, ray.direction[2]), hn::Set(d, ray.error));
      clip_slab<W>(c, node.slab[j], first, near, far);
    }
    return make_entries<W>(index, near, far);
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
