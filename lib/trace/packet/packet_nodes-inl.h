// SPDX-License-Identifier: Apache-2.0
// A packet against the children of a node: with all children at once it finds those that the
// packet, or one beam of it, may meet; with one child the beams that may meet it.
#if defined(SOBB_TRACE_PACKET_PACKET_NODES_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_PACKET_PACKET_NODES_INL_H
#undef SOBB_TRACE_PACKET_PACKET_NODES_INL_H
#else
#define SOBB_TRACE_PACKET_PACKET_NODES_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "base/simd/mask_bits-inl.h"
#include "trace/nodes/slab_clip-inl.h"
#include "trace/packet/packet_rays-inl.h"
#include "trace/packet/packet_table-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// The j-th direction of a basis, which is known along the frame. (Decoding it anyway costs packets
// 6 to 15 %.)
template <class Volumes>
HWY_INLINE uint32_t direction_of(uint32_t basis, uint32_t j) {
  return Volumes::kFrameOnly ? j : basis_direction(basis, static_cast<int>(j));
}

// Returns the beams with rays that may meet a child, one bit each.
template <class Volumes, class Rays>
HWY_INLINE uint32_t beams_that_meet(const Rays& rays, const PacketTable& table,
                                    const typename Volumes::Node& node, uint32_t child) {
  const BeamFloats d;
  const uint32_t basis = node.basis[child];
  uint32_t met = 0;
  for (size_t beam = 0; beam < kBeams; beam += hn::Lanes(d)) {
    auto near = hn::Load(d, rays.beam_near + beam);
    auto far = hn::Load(d, rays.beam_far + beam);
    for (uint32_t j = 0; j < 3; ++j) {
      const uint32_t k = direction_of<Volumes>(basis, j);
      const PacketTable::Entry& e = table.entry[k];
      const uint32_t falls = table.falls[k];
      near = hn::Max(near, plane_distance(hn::Set(d, node.slab[j][falls][child]),
                                          hn::Load(d, e.near_scale + beam),
                                          hn::Load(d, e.near_offset + beam)));
      far = hn::Min(
          far, plane_distance(hn::Set(d, node.slab[j][1 - falls][child]),
                              hn::Load(d, e.far_scale + beam), hn::Load(d, e.far_offset + beam)));
    }
    met |= mask_bits(d, hn::Le(near, far)) << beam;
  }
  return met;
}

// Returns the children that a beam, or the packet as a whole (kWholePacket), may meet, one bit
// each, and from which depth on.
template <class Volumes, class Rays, int W = Volumes::kWidth>
HWY_INLINE uint32_t children_that_meet(const TraceScene& scene, const Rays& rays,
                                       PacketTable& table, const Node<W>& node, uint32_t beam,
                                       float (&nearest)[W]) {
  const ChildFloats<W> d;
  const uint32_t count = child_count(node);
  uint32_t met = 0;
  if (Volumes::kFrameOnly || (node.meta[0] & kSharedBit) != 0) {
    const uint32_t basis = node.basis[0];
    if constexpr (!Volumes::kFrameOnly) table.require(scene, rays, basis);
    for (size_t first = 0; first < W; first += hn::Lanes(d)) {
      auto near = hn::Set(d, rays.beam_near[beam]);
      auto far = hn::Set(d, rays.beam_far[beam]);
      for (uint32_t j = 0; j < 3; ++j) {
        const uint32_t k = direction_of<Volumes>(basis, j);
        const PacketTable::Entry& e = table.entry[k];
        const uint32_t falls = table.falls[k];
        near = hn::Max(
            near, plane_distance(hn::Load(d, node.slab[j][falls] + first),
                                 hn::Set(d, e.near_scale[beam]), hn::Set(d, e.near_offset[beam])));
        far = hn::Min(
            far, plane_distance(hn::Load(d, node.slab[j][1 - falls] + first),
                                hn::Set(d, e.far_scale[beam]), hn::Set(d, e.far_offset[beam])));
      }
      met |= mask_bits(d, hn::Le(near, far)) << first;
      hn::Store(near, d, nearest + first);
    }
    return met & low_bits(count);
  }
  for (uint32_t child = 0; child < count; ++child) {
    const uint32_t basis = node.basis[child];
    table.require(scene, rays, basis);
    float near = rays.beam_near[beam];
    float far = rays.beam_far[beam];
    for (int j = 0; j < 3; ++j) {
      const uint32_t k = basis_direction(basis, j);
      const PacketTable::Entry& e = table.entry[k];
      const uint32_t falls = table.falls[k];
      near = std::max(near, node.slab[j][falls][child] * e.near_scale[beam] + e.near_offset[beam]);
      far = std::min(far, node.slab[j][1 - falls][child] * e.far_scale[beam] + e.far_offset[beam]);
    }
    nearest[child] = near;
    met |= static_cast<uint32_t>(near <= far) << child;
  }
  return met;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
