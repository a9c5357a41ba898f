// SPDX-License-Identifier: Apache-2.0
// A packet of coherent rays through the wide nodes together.
//
// The room packet/ traces neighbours that are alike: which fit together (packet_setup-inl.h), their
// beams (packet_rays-inl.h) against nodes (packet_nodes-inl.h, packet_table-inl.h) and triangles
// (packet_triangles-inl.h); trace_packets-inl.h gives rays that fit in no packet to single/. It
// knows ray/, nodes/, triangles/ and single/.
#if defined(SOBB_TRACE_PACKET_TRAVERSAL_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_PACKET_TRAVERSAL_INL_H
#undef SOBB_TRACE_PACKET_TRAVERSAL_INL_H
#else
#define SOBB_TRACE_PACKET_TRAVERSAL_INL_H
#endif

#include <hwy/highway.h>

#include <utility>

#include "trace/nodes/child_order.h"
#include "trace/nodes/file_volumes-inl.h"
#include "trace/nodes/prefetch-inl.h"
#include "trace/packet/packet_key.h"
#include "trace/packet/packet_nodes-inl.h"
#include "trace/packet/packet_setup-inl.h"
#include "trace/packet/packet_triangles-inl.h"
#include "trace/ray/validity.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

// Children visited per ray after which a packet is given up.
template <Query kQuery>
constexpr int kMostVisits = kQuery == Query::kAny ? 6 : 12;

// Returns false if it gave up, since the rays meet more than they would one by one.
template <class Volumes, Query kQuery, int kSize, bool kOwnOrigins>
HWY_INLINE bool traverse(const TraceScene& scene, PacketRays<kSize, kOwnOrigins>& rays,
                         uint32_t beams) {
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
    const bool one_beam = (beams & (beams - 1)) == 0;
    const uint32_t beam =
        one_beam ? static_cast<uint32_t>(std::countr_zero(beams)) : uint32_t{kWholePacket};
    alignas(64) float nearest[kWidth];
    uint32_t met = children_that_meet<Volumes>(scene, rays, table, node, beam, nearest);
    PacketKey key = kNoPacketKey;
    if (std::has_single_bit(met)) {
      const auto child = static_cast<uint32_t>(std::countr_zero(met));
      const uint32_t reference = node.reference[child];
      if ((node.meta[child] & kLeafBit) == 0) {
        index = reference;
        continue;
      }
      test_leaf<kQuery>(rays, scene.blocks + reference, node.meta[child] & kTriangleMask, beams);
    } else {
      PacketKey* const base = top;
      for (; met != 0; met &= met - 1) {
        const auto child = static_cast<uint32_t>(std::countr_zero(met));
        prefetch<Node>(scene, make_key(0, node.meta[child], node.reference[child]));
        PacketKey other = make_packet_key(nearest[child], beams, child, index);
        if (other < key) std::swap(other, key);
        if (other == kNoPacketKey) continue;
        *make_room(base, top++, [other](PacketKey below) { return below < other; }) = other;
      }
    }
    for (;; key = kNoPacketKey) {
      if (key == kNoPacketKey) {
        if (top == stack) return true;
        key = *--top;
      }
      if (packet_key_depth(key) > rays.beam_far[kWholePacket]) continue;
      if (--left == 0) return false;
      const Node& parent = nodes[packet_key_node(key)];
      const uint32_t child = packet_key_child(key);
      beams = packet_key_beams(key) & beams_that_meet<Volumes>(rays, table, parent, child);
      if (beams == 0) continue;
      const uint32_t meta = parent.meta[child];
      index = parent.reference[child];
      if ((meta & kLeafBit) == 0) break;
      test_leaf<kQuery>(rays, scene.blocks + index, meta & kTriangleMask, beams);
    }
  }
}

template <class Rays>
HWY_INLINE void store(const Rays& rays, size_t i, sobb_hit& hit) {
  hit = rays.primitive[i] == SOBB_MISS ? ClosestHit::missed(SOBB_MISS)
                                       : sobb_hit{rays.limit[i],     rays.u[i],     rays.v[i],
                                                  rays.primitive[i], kOnlyGeometry, kNoInstance};
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
  const uint64_t taken = PacketSetup<kSize, kOwnOrigins>(scene, packet).take(rays, mask);
  constexpr int kFewest = kSize / 8;
  constexpr float kWidest = 0.02F;
  if (std::popcount(taken) < kFewest) return 0;
  if (packet.spread[0] + packet.spread[1] > kWidest) return 0;
  uint32_t beams = 0;
  for (int beam = 0; beam < kBeams; ++beam) {
    constexpr int kBeamRays = Rays::kBeamRays;
    beams |= static_cast<uint32_t>((taken >> (beam * kBeamRays) & low_bits(kBeamRays)) != 0)
             << beam;
  }
  if (!traverse<Volumes, kQuery>(scene, packet, beams)) return 0;
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
