// SPDX-License-Identifier: Apache-2.0
// A packet of rays through the wide nodes together: rays vary over the lanes, and a lookup in the
// table is a load. Included once for each Highway target.
#if defined(SOBB_TRACE_PACKET_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_PACKET_INL_H
#undef SOBB_TRACE_PACKET_INL_H
#else
#define SOBB_TRACE_PACKET_INL_H
#endif

#include <hwy/highway.h>

#include <optional>

#include "trace/single-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using RayFloats = hn::CappedTag<float, 8>;

// A packet's side of the slab tests: by direction, then by ray.
struct PacketTable {
  alignas(64) float reciprocal[kMaxDirections][kPacketSize];
  alignas(64) float near[kMaxDirections][kPacketSize];
  alignas(64) float far[kMaxDirections][kPacketSize];
};

// The rays of a packet. Lanes of rays that are not traced stay inactive: their limit is negative.
struct PacketRays {
  alignas(64) float tmin[kPacketSize];
  alignas(64) float limit[kPacketSize];
  double scale[kPacketSize];
  std::optional<BlockRay> block_ray[kPacketSize];
  PacketTable table;

  void make(const Tracer& tracer, const sobb_ray* rays, uint32_t active,
            const std::optional<ClosestHit>* best) {
    alignas(64) float origin[3][kPacketSize] = {};
    alignas(64) float direction[3][kPacketSize] = {};
    alignas(64) float error[kPacketSize] = {};
    for (int i = 0; i < kPacketSize; ++i) {
      tmin[i] = 0;
      limit[i] = -1;
      if ((active >> i & 1) == 0) continue;
      const ScaledRay scaled(tracer, rays[i]);
      block_ray[i].emplace(rays[i], scaled);
      for (int k = 0; k < 3; ++k) {
        origin[k][i] = scaled.origin[k];
        direction[k][i] = scaled.direction[k];
      }
      error[i] = scaled.error;
      tmin[i] = scaled.tmin;
      limit[i] = scale_limit(best[i]->limit, scaled.scale);
      scale[i] = scaled.scale;
    }
    const RayFloats d;
    const DirectionTable& directions = tracer.directions;
    for (uint32_t k = 0; k < directions.count; ++k) {
      for (size_t i = 0; i < kPacketSize; i += hn::Lanes(d)) {
        const auto c = slab_coefficients(
            d, hn::Set(d, directions.x[k]), hn::Set(d, directions.y[k]),
            hn::Set(d, directions.z[k]), hn::Load(d, origin[0] + i), hn::Load(d, origin[1] + i),
            hn::Load(d, origin[2] + i), hn::Load(d, direction[0] + i),
            hn::Load(d, direction[1] + i), hn::Load(d, direction[2] + i), hn::Load(d, error + i));
        hn::Store(c.reciprocal, d, table.reciprocal[k] + i);
        hn::Store(c.near, d, table.near[k] + i);
        hn::Store(c.far, d, table.far[k] + i);
      }
    }
  }
};

// One child against all rays: the mask of those that meet it, and the least near distance of them.
template <int W>
HWY_INLINE uint32_t test_child(const PacketRays& rays, const Node<W>& node, uint32_t child,
                               float& nearest) {
  const RayFloats d;
  const uint32_t basis = node.basis[child];
  uint32_t met = 0;
  auto least = hn::Set(d, INFINITY);
  for (size_t i = 0; i < kPacketSize; i += hn::Lanes(d)) {
    auto near = hn::Load(d, rays.tmin + i);
    auto far = hn::Load(d, rays.limit + i);
    for (int j = 0; j < 3; ++j) {
      const uint32_t k = basis_direction(basis, j);
      const auto r = hn::Load(d, rays.table.reciprocal[k] + i);
      const auto lower = hn::Mul(hn::Set(d, node.slab[j][0][child]), r);
      const auto upper = hn::Mul(hn::Set(d, node.slab[j][1][child]), r);
      near = hn::Max(near, hn::Add(hn::Min(lower, upper), hn::Load(d, rays.table.near[k] + i)));
      far = hn::Min(far, hn::Add(hn::Max(lower, upper), hn::Load(d, rays.table.far[k] + i)));
    }
    const auto meets = hn::Le(near, far);
    least = hn::Min(least, hn::IfThenElse(meets, near, hn::Set(d, INFINITY)));
    uint8_t bits[8] = {};
    hn::StoreMaskBits(d, meets, bits);
    met |= static_cast<uint32_t>(bits[0]) << i;
  }
  nearest = hn::GetLane(hn::MinOfLanes(d, least));
  return met;
}

// The rays whose limit is not before a distance.
HWY_INLINE uint32_t rays_beyond(const PacketRays& rays, float distance) {
  const RayFloats d;
  uint32_t beyond = 0;
  for (size_t i = 0; i < kPacketSize; i += hn::Lanes(d)) {
    uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Ge(hn::Load(d, rays.limit + i), hn::Set(d, distance)), bits);
    beyond |= static_cast<uint32_t>(bits[0]) << i;
  }
  return beyond;
}

// A node to visit: its key, and the rays that meet it.
struct PacketEntry {
  StackKey key;
  uint32_t mask;
};

// Pushes the children that a ray meets, furthest first by the packet's nearest ray.
template <int W>
HWY_INLINE void push_children(const PacketRays& rays, const Node<W>& node, uint32_t mask,
                              PacketEntry*& top) {
  PacketEntry* const base = top;
  for (uint32_t child = 0; child < child_count(node); ++child) {
    float nearest;
    const uint32_t met = test_child(rays, node, child, nearest) & mask;
    if (met == 0) continue;
    const uint32_t meta = node.meta[child];
    const uint32_t high = (std::bit_cast<uint32_t>(nearest) << 1 & ~kKeyMetaMask) |
                          (meta >> 9 & kLeafBit >> 9) | (meta & kTriangleMask);
    const PacketEntry entry = {static_cast<StackKey>(high) << 32 | node.reference[child], met};
    PacketEntry* at = top++;
    for (; at != base && at[-1].key < entry.key; --at) *at = at[-1];
    *at = entry;
  }
}

// The distance of a key, as it was rounded down.
HWY_INLINE float key_distance(StackKey key) {
  return std::bit_cast<float>(static_cast<uint32_t>(key >> 32 & ~StackKey{kKeyMetaMask}) >> 1);
}

template <int W, Query kQuery>
HWY_INLINE void trace_packet(const Tracer& tracer, const sobb_ray* rays, uint32_t active,
                             std::optional<ClosestHit>* best) {
  PacketRays packet;
  packet.make(tracer, rays, active, best);
  const auto* nodes = static_cast<const Node<W>*>(tracer.nodes);

  PacketEntry stack[kMaxDepth * (W - 1) + 2];
  PacketEntry* top = stack;
  *top++ = {kRootKey, active};
  while (top != stack) {
    const PacketEntry entry = *--top;
    uint32_t mask = entry.mask & rays_beyond(packet, key_distance(entry.key));
    if (mask == 0) continue;
    if (!key_is_leaf(entry.key)) {
      push_children(packet, nodes[key_index(entry.key)], mask, top);
      continue;
    }
    for (; mask != 0; mask &= mask - 1) {
      const auto i = static_cast<uint32_t>(std::countr_zero(mask));
      if (test_leaf<kQuery>(*packet.block_ray[i], tracer.blocks + key_index(entry.key),
                            key_triangles(entry.key), rays[i].tmin, packet.limit[i], *best[i])) {
        // An occluded ray is done: no distance is before a negative limit.
        packet.limit[i] =
            kQuery == Query::kAny ? -1.0F : scale_limit(best[i]->limit, packet.scale[i]);
      }
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
