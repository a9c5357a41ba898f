// SPDX-License-Identifier: Apache-2.0
// The tracing kernels, compiled once for each instruction set, and the table that chooses among
// them.
#include <algorithm>
#include <optional>

#include "base/instruction_sets.h"
#include "trace/trace.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/batch/traversal-inl.h"
#include "trace/nodes/file_volumes-inl.h"
#include "trace/packet/trace_packets-inl.h"
#include "trace/single/trace_rays-inl.h"
#include "trace/wave/traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

// Calls a function with the volumes of the hierarchy's nodes, so that each kernel is compiled for
// each of them.
template <class Function>
uint64_t with_volumes(const Tracer& tracer, const Function& function) {
  if (tracer.width == 4) {
    return tracer.frame_only ? function(FileVolumes<4, true>()) : function(FileVolumes<4, false>());
  }
  return tracer.frame_only ? function(FileVolumes<8, true>()) : function(FileVolumes<8, false>());
}

template <Query kQuery, class Result>
uint64_t single(const Tracer& tracer, const sobb_ray* rays, uint64_t count, Result* results,
                sobb_count* counts) {
  return with_volumes(tracer, [&](auto volumes) HWY_ATTR {
    return trace_rays<decltype(volumes), kQuery>(tracer, rays, count, results, counts);
  });
}

template <Query kQuery, class Result>
uint64_t packet(const Tracer& tracer, const sobb_ray* rays, uint32_t mask, Result* results) {
  return with_volumes(tracer, [&](auto volumes) HWY_ATTR {
    return trace_packet<decltype(volumes), kPacketSize, kQuery>(tracer, rays, mask, results);
  });
}

template <Query kQuery, class Result>
uint64_t array_in_packets(const Tracer& tracer, const sobb_ray* rays, uint64_t count,
                          Result* results, void* /*scratch*/) {
  return with_volumes(tracer, [&](auto volumes) HWY_ATTR {
    return trace_packets<decltype(volumes), kQuery>(tracer, rays, count, results);
  });
}

template <Query kQuery, class Result>
uint64_t array_in_batch(const Tracer& tracer, const sobb_ray* rays, uint64_t count, Result* results,
                        void* scratch) {
  auto& batch = *new (scratch) Batch;
  return with_volumes(tracer, [&](auto volumes) HWY_ATTR {
    return trace_batch<decltype(volumes), kQuery>(tracer, rays, static_cast<uint32_t>(count),
                                                  results, batch);
  });
}

template <Query kQuery, class Result>
uint64_t array_in_waves(const Tracer& tracer, const sobb_ray* rays, uint64_t count, Result* results,
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
      std::max(sizeof(Batch), sizeof(WaveMemory<8>)),
      {array_in_batch<Query::kClosest, sobb_hit>, array_in_waves<Query::kClosest, sobb_hit>,
       array_in_packets<Query::kClosest, sobb_hit>},
      {array_in_batch<Query::kAny, uint8_t>, array_in_waves<Query::kAny, uint8_t>,
       array_in_packets<Query::kAny, uint8_t>},
      single<Query::kClosest, sobb_hit>,
      single<Query::kAny, uint8_t>,
      packet<Query::kClosest, sobb_hit>,
      packet<Query::kAny, uint8_t>};
  return kKernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sobb {
namespace {

// Stops at the first node that is not on the frame.
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
  return SOBB_DISPATCH(isa, target_trace_kernels)();
}

}  // namespace sobb
#endif
