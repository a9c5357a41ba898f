// SPDX-License-Identifier: Apache-2.0
// The tracing kernels of every target, and the table that chooses among them.
#include <optional>

#include "base/highway_targets.h"
#include "trace/tracer.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/file_volumes-inl.h"
#include "trace/packet-inl.h"
#include "trace/trace_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

template <Query kQuery, class Result>
uint64_t trace(const Tracer& tracer, const sobb_ray* rays, uint64_t count, Result* results,
               sobb_count* counts) {
  const auto with = [&](auto volumes) HWY_ATTR {
    return trace_rays<decltype(volumes), kQuery>(tracer, rays, count, results, counts);
  };
  if (tracer.width == 4) {
    return tracer.axes_only ? with(FileVolumes<4, true>()) : with(FileVolumes<4, false>());
  }
  return tracer.axes_only ? with(FileVolumes<8, true>()) : with(FileVolumes<8, false>());
}

template <Query kQuery, class Result>
uint64_t trace_packet(const Tracer& tracer, const sobb_ray* rays, uint32_t mask, Result* results) {
  std::optional<ClosestHit> best[kPacketSize];
  uint32_t active = 0;
  for (uint32_t left = mask; left != 0; left &= left - 1) {
    const auto i = static_cast<uint32_t>(std::countr_zero(left));
    if (is_valid(rays[i])) {
      best[i].emplace(rays[i]);
      active |= 1U << i;
    } else {
      store_invalid(results[i]);
    }
  }
  if (tracer.width == 4) {
    trace_packet<4, kQuery>(tracer, rays, active, best);
  } else {
    trace_packet<8, kQuery>(tracer, rays, active, best);
  }
  for (uint32_t left = active; left != 0; left &= left - 1) {
    const auto i = static_cast<uint32_t>(std::countr_zero(left));
    store(*best[i], results[i]);
  }
  return static_cast<uint64_t>(std::popcount(mask ^ active));
}

}  // namespace

const TraceKernels& target_trace_kernels() {
  static constexpr TraceKernels kKernels = {
      trace<Query::kClosest, sobb_hit>, trace<Query::kAny, uint8_t>,
      trace_packet<Query::kClosest, sobb_hit>, trace_packet<Query::kAny, uint8_t>};
  return kKernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sobb {

Tracer::Tracer(const FileView& view)
    : TraceScene{make_direction_table(view.directions),
                 {view.header->centre[0], view.header->centre[1], view.header->centre[2]},
                 view.header->radius,
                 view.nodes,
                 view.blocks.data()},
      width(view.header->width),
      axes_only(view.header->volume == SOBB_VOLUME_AABB) {}

const TraceKernels& trace_kernels(sobb_isa isa) {
  return isa == SOBB_ISA_AVX2 ? N_AVX2::target_trace_kernels() : N_SSE4::target_trace_kernels();
}

}  // namespace sobb
#endif
