// SPDX-License-Identifier: Apache-2.0
// The tracing kernels of every target, and the table that chooses among them.
#include <algorithm>
#include <optional>

#include "base/highway_targets.h"
#include "trace/trace.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/kernels.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/batch/traversal-inl.h"
#include "trace/nodes/file_volumes-inl.h"
#include "trace/packet/traversal-inl.h"
#include "trace/single/trace_rays-inl.h"
#include "trace/wave/traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

// Calls a function with what the hierarchy's volumes are.
template <class Function>
uint64_t with_volumes(const Tracer& tracer, const Function& function) {
  if (tracer.width == 4) {
    return tracer.frame_only ? function(FileVolumes<4, true>()) : function(FileVolumes<4, false>());
  }
  return tracer.frame_only ? function(FileVolumes<8, true>()) : function(FileVolumes<8, false>());
}

template <Query kQuery, class Result>
uint64_t trace(const Tracer& tracer, const sobb_ray* rays, uint64_t count, Result* results,
               sobb_count* counts) {
  return with_volumes(tracer, [&](auto volumes) HWY_ATTR {
    return trace_rays<decltype(volumes), kQuery>(tracer, rays, count, results, counts);
  });
}

// Rays of a packet: those that are coherent together, in a few groups, then of a large packet what
// is left in small ones, of a small one ray by ray.
template <int kSize, Query kQuery, class Result>
uint64_t trace_packet(const Tracer& tracer, const sobb_ray* rays, uint64_t mask, Result* results) {
  uint64_t left = mask;
  const sobb_ray* all = rays;
  sobb_ray copies[kSize];
  if (mask != ~uint64_t{0} >> (64 - kSize) && mask != 0) {  // others may not be read
    for (size_t i = 0; i < kSize; ++i) {
      copies[i] = rays[(mask >> i & 1) != 0 ? i : std::countr_zero(mask)];
    }
    all = copies;
  }
  while (left != 0) {
    const uint64_t traced = with_volumes(tracer, [&](auto volumes) HWY_ATTR {
      return trace_coherent<decltype(volumes), kQuery, kSize>(tracer, all, left, results);
    });
    if (traced == 0) break;
    left &= ~traced;
  }
  uint64_t invalid = 0;
  if constexpr (kSize > kPacketSize) {
    constexpr uint64_t kPart = ~uint64_t{0} >> (64 - kPacketSize);
    for (int first = 0; first < kSize; first += kPacketSize) {
      const uint64_t part = left >> first & kPart;
      if (part == 0) continue;
      invalid += trace_packet<kPacketSize, kQuery>(tracer, rays + first, part, results + first);
    }
    return invalid;
  }
  while (left != 0) {
    const int first = std::countr_zero(left);
    const int count = std::countr_one(left >> first);
    invalid +=
        trace<kQuery>(tracer, rays + first, static_cast<uint64_t>(count), results + first, nullptr);
    left &= left + (uint64_t{1} << first);
  }
  return invalid;
}

template <Query kQuery, class Result>
uint64_t trace_16(const Tracer& tracer, const sobb_ray* rays, uint32_t mask, Result* results) {
  return trace_packet<kPacketSize, kQuery>(tracer, rays, mask, results);
}

template <Query kQuery, class Result>
uint64_t trace_packets(const Tracer& tracer, const sobb_ray* rays, uint64_t count, Result* results,
                       void* /*scratch*/) {
  uint64_t invalid = 0;
  for (uint64_t first = 0; first < count; first += 64) {
    const uint64_t size = std::min<uint64_t>(64, count - first);
    for (uint64_t next = first + 64; next < std::min(first + 128, count); next += 2) {
      hwy::Prefetch(rays + next);
    }
    invalid += trace_packet<64, kQuery>(tracer, rays + first, ~uint64_t{0} >> (64 - size),
                                        results + first);
  }
  return invalid;
}

template <Query kQuery, class Result>
uint64_t trace_batch(const Tracer& tracer, const sobb_ray* rays, uint64_t count, Result* results,
                     void* scratch) {
  auto& batch = *new (scratch) StreamBatch;
  return with_volumes(tracer, [&](auto volumes) HWY_ATTR {
    return trace_stream<decltype(volumes), kQuery>(tracer, rays, static_cast<uint32_t>(count),
                                                   results, batch);
  });
}

template <Query kQuery, class Result>
uint64_t trace_wave(const Tracer& tracer, const sobb_ray* rays, uint64_t count, Result* results,
                    void* scratch) {
  return with_volumes(tracer, [&](auto volumes) HWY_ATTR {
    using Volumes = decltype(volumes);
    auto& memory = *new (scratch) WaveMemory<Volumes::kWidth>;
    return Wave<Volumes, kQuery, Result>(tracer, rays, count, results, memory).trace();
  });
}

}  // namespace

const TraceKernels& target_trace_kernels() {
  static constexpr TraceKernels kKernels = {
      std::max(sizeof(StreamBatch), sizeof(WaveMemory<8>)),
      {trace_batch<Query::kClosest, sobb_hit>, trace_wave<Query::kClosest, sobb_hit>,
       trace_packets<Query::kClosest, sobb_hit>},
      {trace_batch<Query::kAny, uint8_t>, trace_wave<Query::kAny, uint8_t>,
       trace_packets<Query::kAny, uint8_t>},
      trace<Query::kClosest, sobb_hit>,
      trace<Query::kAny, uint8_t>,
      trace_16<Query::kClosest, sobb_hit>,
      trace_16<Query::kAny, uint8_t>};
  return kKernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sobb {
namespace {

// Where one is not, that is told soon.
template <int W>
bool all_on_frame(const FileView& view) {
  const auto nodes = view.nodes_of<W>();
  return std::all_of(nodes.begin(), nodes.end(), on_frame<Node<W>>);
}

}  // namespace

Tracer::Tracer(const FileView& view)
    : TraceScene{make_direction_table(view.directions),
                 {view.header->centre[0], view.header->centre[1], view.header->centre[2]},
                 view.header->radius,
                 view.nodes,
                 view.blocks.data()},
      width(view.header->width),
      frame_only(view.header->width == 4 ? all_on_frame<4>(view) : all_on_frame<8>(view)) {}

const TraceKernels& trace_kernels(sobb_isa isa) {
  return isa == SOBB_ISA_AVX2 ? N_AVX2::target_trace_kernels() : N_SSE4::target_trace_kernels();
}

}  // namespace sobb
#endif
