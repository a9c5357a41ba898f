// SPDX-License-Identifier: Apache-2.0
// Packets of rays, coherent or not: those that are coherent together are traced in a few groups;
// then what is left of a large packet goes in small ones, of a small one ray by ray.
#if defined(SOBB_TRACE_PACKET_TRACE_PACKETS_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_PACKET_TRACE_PACKETS_INL_H
#undef SOBB_TRACE_PACKET_TRACE_PACKETS_INL_H
#else
#define SOBB_TRACE_PACKET_TRACE_PACKETS_INL_H
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>

#include "trace/packet/traversal-inl.h"
#include "trace/single/trace_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

// The rays of a large packet: all that an array's packets have.
inline constexpr int kLargePacket = 64;

// Traces the rays of the mask. Returns how many were not valid.
template <NodeVolumes Volumes, int kSize, Query kQuery, class Result>
uint64_t trace_packet(const TraceScene& scene, const sobb_ray* rays, uint64_t mask,
                      Result* results) {
  constexpr uint64_t kAll = ~uint64_t{0} >> (64 - kSize);
  uint64_t left = mask;
  const sobb_ray* all = rays;
  sobb_ray copies[kSize];
  if (mask != kAll && mask != 0) {  // rays off the mask may not be read
    for (size_t i = 0; i < kSize; ++i) {
      copies[i] = rays[(mask >> i & 1) != 0 ? i : std::countr_zero(mask)];
    }
    all = copies;
  }
  while (left != 0) {
    const uint64_t traced = trace_coherent<Volumes, kQuery, kSize>(scene, all, left, results);
    if (traced == 0) break;
    left &= ~traced;
  }
  uint64_t invalid = 0;
  if constexpr (kSize > kPacketSize) {
    constexpr uint64_t kPart = ~uint64_t{0} >> (64 - kPacketSize);
    for (int first = 0; first < kSize; first += kPacketSize) {
      const uint64_t part = left >> first & kPart;
      if (part == 0) continue;
      invalid +=
          trace_packet<Volumes, kPacketSize, kQuery>(scene, rays + first, part, results + first);
    }
    return invalid;
  }
  while (left != 0) {
    const int first = std::countr_zero(left);
    const int count = std::countr_one(left >> first);
    invalid += trace_rays<Volumes, kQuery>(scene, rays + first, static_cast<uint64_t>(count),
                                           results + first, nullptr);
    left &= left + (uint64_t{1} << first);
  }
  return invalid;
}

// Traces an array in large packets.
template <NodeVolumes Volumes, Query kQuery, class Result>
uint64_t trace_packets(const TraceScene& scene, const sobb_ray* rays, uint64_t count,
                       Result* results) {
  uint64_t invalid = 0;
  for (uint64_t first = 0; first < count; first += kLargePacket) {
    const uint64_t size = std::min<uint64_t>(kLargePacket, count - first);
    const uint64_t next_end = std::min(first + 2 * kLargePacket, count);
    for (uint64_t next = first + kLargePacket; next < next_end; next += 2) {
      hwy::Prefetch(rays + next);
    }
    invalid += trace_packet<Volumes, kLargePacket, kQuery>(
        scene, rays + first, ~uint64_t{0} >> (64 - size), results + first);
  }
  return invalid;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
