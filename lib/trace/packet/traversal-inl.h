// SPDX-License-Identifier: Apache-2.0
// A packet of coherent rays through the wide nodes together. Included once for each Highway target.
#if defined(SOBB_TRACE_PACKET_TRAVERSAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_PACKET_TRAVERSAL_INL_H
#undef SOBB_TRACE_PACKET_TRAVERSAL_INL_H
#else
#define SOBB_TRACE_PACKET_TRAVERSAL_INL_H
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "trace/packet/packet_table-inl.h"
#include "trace/packet/packet_triangles-inl.h"
#include "trace/single/trace_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// The j-th direction of a basis; along the frame that is known.
template <class Volumes>
HWY_INLINE uint32_t direction_of(uint32_t basis, uint32_t j) {
  return Volumes::kFrameOnly ? j : basis_direction(basis, static_cast<int>(j));
}

// The lanes with rays that may meet a child.
template <class Volumes, class Rays>
HWY_INLINE uint32_t meet_child(const Rays& rays, const PacketTable& table,
                               const typename Volumes::Node& node, uint32_t child) {
  const RayFloats d;
  const uint32_t basis = node.basis[child];
  uint32_t met = 0;
  for (size_t lane = 0; lane < kPacketLanes; lane += hn::Lanes(d)) {
    auto near = hn::Load(d, rays.lane_near + lane);
    auto far = hn::Load(d, rays.lane_far + lane);
    for (uint32_t j = 0; j < 3; ++j) {
      const uint32_t k = direction_of<Volumes>(basis, j);
      const PacketTable::Entry& e = table.entry[k];
      const uint32_t falls = table.falls[k];
      near = hn::Max(
          near, hn::MulAdd(hn::Set(d, node.slab[j][falls][child]), hn::Load(d, e.near_scale + lane),
                           hn::Load(d, e.near_offset + lane)));
      far = hn::Min(far,
                    hn::MulAdd(hn::Set(d, node.slab[j][1 - falls][child]),
                               hn::Load(d, e.far_scale + lane), hn::Load(d, e.far_offset + lane)));
    }
    met |= mask_bits(d, hn::Le(near, far)) << lane;
  }
  return met;
}

// A child to visit, ordered by depth:
//   bits 43-63  the least depth's exponent and upper 13 mantissa bits (it is not negative)
//   bits 35-42  the lanes that met the child's node
//   bits 32-34  the child;  bits 0-31  its node
using PacketKey = uint64_t;
constexpr PacketKey kNoPacketKey = ~PacketKey{0};

HWY_INLINE PacketKey make_packet_key(float near, uint32_t lanes, uint32_t child, uint32_t node) {
  return static_cast<PacketKey>(std::bit_cast<uint32_t>(near) >> 10) << 43 |
         static_cast<PacketKey>(lanes << 3 | child) << 32 | node;
}
HWY_INLINE float packet_key_depth(PacketKey key) {
  return std::bit_cast<float>(static_cast<uint32_t>(key >> 43) << 10);
}
constexpr uint32_t packet_key_lanes(PacketKey key) { return key >> 35 & 0xFF; }
constexpr uint32_t packet_key_child(PacketKey key) { return key >> 32 & 7; }
constexpr uint32_t packet_key_node(PacketKey key) { return static_cast<uint32_t>(key); }

// The children that a lane, or the packet as a whole, may meet, and from which depth on.
template <class Volumes, class Rays, int W = Volumes::kWidth>
HWY_INLINE uint32_t meet_children(const TraceScene& scene, const Rays& rays, PacketTable& table,
                                  const Node<W>& node, uint32_t column, float (&nearest)[W]) {
  const ChildFloats<W> d;
  const uint32_t count = child_count(node);
  uint32_t met = 0;
  if (Volumes::kFrameOnly || (node.meta[0] & kSharedBit) != 0) {
    const uint32_t basis = node.basis[0];
    if constexpr (!Volumes::kFrameOnly) table.require(scene, rays, basis);
    for (size_t first = 0; first < W; first += hn::Lanes(d)) {
      auto near = hn::Set(d, rays.lane_near[column]);
      auto far = hn::Set(d, rays.lane_far[column]);
      for (uint32_t j = 0; j < 3; ++j) {
        const uint32_t k = direction_of<Volumes>(basis, j);
        const PacketTable::Entry& e = table.entry[k];
        const uint32_t falls = table.falls[k];
        near = hn::Max(
            near, hn::MulAdd(hn::Load(d, node.slab[j][falls] + first),
                             hn::Set(d, e.near_scale[column]), hn::Set(d, e.near_offset[column])));
        far = hn::Min(
            far, hn::MulAdd(hn::Load(d, node.slab[j][1 - falls] + first),
                            hn::Set(d, e.far_scale[column]), hn::Set(d, e.far_offset[column])));
      }
      met |= mask_bits(d, hn::Le(near, far)) << first;
      hn::Store(near, d, nearest + first);
    }
    return met & ((1U << count) - 1);
  }
  for (uint32_t child = 0; child < count; ++child) {
    const uint32_t basis = node.basis[child];
    table.require(scene, rays, basis);
    float near = rays.lane_near[column];
    float far = rays.lane_far[column];
    for (int j = 0; j < 3; ++j) {
      const uint32_t k = basis_direction(basis, j);
      const PacketTable::Entry& e = table.entry[k];
      const uint32_t falls = table.falls[k];
      near =
          std::max(near, node.slab[j][falls][child] * e.near_scale[column] + e.near_offset[column]);
      far = std::min(far,
                     node.slab[j][1 - falls][child] * e.far_scale[column] + e.far_offset[column]);
    }
    nearest[child] = near;
    met |= static_cast<uint32_t>(near <= far) << child;
  }
  return met;
}

// Asks for a child, all of a node or as much of a leaf, before it is its turn.
template <int W>
HWY_INLINE void prefetch_child(const TraceScene& scene, const Node<W>* nodes, const Node<W>& node,
                               uint32_t child) {
  const uint32_t index = node.reference[child];
  const bool leaf = (node.meta[child] & kLeafBit) != 0;
  const auto* bytes = leaf ? reinterpret_cast<const uint8_t*>(scene.blocks + index)
                           : reinterpret_cast<const uint8_t*>(nodes + index);
  for (size_t line = 0; line < sizeof(Node<W>); line += 64) hwy::Prefetch(bytes + line);
}

// Children visited for each ray after which a packet is given up.
template <Query kQuery>
constexpr int kMostVisits = kQuery == Query::kAny ? 6 : 12;

// Returns false if it gave up, since the rays meet more than they would one by one.
template <class Volumes, Query kQuery, int kSize, bool kOwnOrigins>
HWY_INLINE bool traverse(const TraceScene& scene, PacketRays<kSize, kOwnOrigins>& rays,
                         uint32_t lanes) {
  constexpr int kWidth = Volumes::kWidth;
  using Node = typename Volumes::Node;
  PacketTable table;
  if constexpr (Volumes::kFrameOnly) table.require(scene, rays, kAxesBasis);
  const auto* nodes = static_cast<const Node*>(scene.nodes);
  PacketKey stack[kMaxDepth * (kWidth - 1) + 1];
  PacketKey* top = stack;
  uint32_t index = 0;
  int left = kMostVisits<kQuery> * kSize;
  for (;;) {
    const Node& node = nodes[index];
    const bool one_lane = (lanes & (lanes - 1)) == 0;
    const uint32_t column = one_lane ? static_cast<uint32_t>(std::countr_zero(lanes)) : kAllLanes;
    alignas(64) float nearest[kWidth];
    uint32_t met = meet_children<Volumes>(scene, rays, table, node, column, nearest);
    PacketKey key = kNoPacketKey;
    if (std::has_single_bit(met)) {
      const auto child = static_cast<uint32_t>(std::countr_zero(met));
      const uint32_t reference = node.reference[child];
      if ((node.meta[child] & kLeafBit) == 0) {
        index = reference;
        continue;
      }
      test_leaf<kQuery>(rays, scene.blocks + reference, node.meta[child] & kTriangleMask, lanes);
    } else {
      PacketKey* const base = top;
      for (; met != 0; met &= met - 1) {
        const auto child = static_cast<uint32_t>(std::countr_zero(met));
        prefetch_child(scene, nodes, node, child);
        PacketKey other = make_packet_key(nearest[child], lanes, child, index);
        if (other < key) std::swap(other, key);
        if (other == kNoPacketKey) continue;
        PacketKey* at = top++;
        for (; at != base && at[-1] < other; --at) *at = at[-1];
        *at = other;
      }
    }
    for (;; key = kNoPacketKey) {
      if (key == kNoPacketKey) {
        if (top == stack) return true;
        key = *--top;
      }
      if (packet_key_depth(key) > rays.lane_far[kAllLanes]) continue;
      if (--left == 0) return false;
      const Node& parent = nodes[packet_key_node(key)];
      const uint32_t child = packet_key_child(key);
      lanes = packet_key_lanes(key) & meet_child<Volumes>(rays, table, parent, child);
      if (lanes == 0) continue;
      const uint32_t meta = parent.meta[child];
      index = parent.reference[child];
      if ((meta & kLeafBit) == 0) break;
      test_leaf<kQuery>(rays, scene.blocks + index, meta & kTriangleMask, lanes);
    }
  }
}

template <class Rays>
HWY_INLINE void store(const Rays& rays, size_t i, sobb_hit& hit) {
  hit = rays.primitive[i] == SOBB_MISS
            ? ClosestHit::missed(SOBB_MISS)
            : sobb_hit{rays.limit[i], rays.u[i], rays.v[i], rays.primitive[i], 0, SOBB_MISS};
}
template <class Rays>
HWY_INLINE void store(const Rays& rays, size_t i, uint8_t& occluded) {
  occluded = rays.primitive[i] == SOBB_MISS ? SOBB_FREE : SOBB_OCCLUDED;
}

// Traces those of the rays that are coherent with the first of them, and returns which they are:
// none if they are too few or too wide to gain.
template <class Volumes, Query kQuery, int kSize, class Result>
HWY_NOINLINE uint64_t trace_coherent(const TraceScene& scene, const sobb_ray* rays, uint64_t mask,
                                     Result* results) {
  const sobb_ray& first = rays[std::countr_zero(mask)];
  if (!is_valid(first)) return 0;
  constexpr bool kOwnOrigins = kQuery == Query::kAny;
  using Rays = PacketRays<kSize, kOwnOrigins>;
  const sobb_ray& last = rays[63 - std::countl_zero(mask)];
  Rays packet(scene, first, find_focus<kOwnOrigins>(first, last));
  if (!(packet.centred.error < INFINITY)) return 0;
  const uint64_t taken = PacketTaker<kSize, kOwnOrigins>(scene, packet).take(rays, mask);
  constexpr int kFewest = kSize / 8;
  constexpr float kWidest = 0.02F;
  if (std::popcount(taken) < kFewest) return 0;
  if (packet.spread[0] + packet.spread[1] > kWidest) return 0;
  uint32_t lanes = 0;
  for (int lane = 0; lane < kPacketLanes; ++lane) {
    constexpr int kRun = Rays::kRun;
    lanes |= static_cast<uint32_t>((taken >> (lane * kRun) & ((1U << kRun) - 1)) != 0) << lane;
  }
  if (!traverse<Volumes, kQuery>(scene, packet, lanes)) return 0;
  for (uint64_t left = taken; left != 0; left &= left - 1) {
    const auto i = static_cast<size_t>(std::countr_zero(left));
    store(packet, i, results[i]);
  }
  return taken;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
