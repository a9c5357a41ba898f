// SPDX-License-Identifier: Apache-2.0
// What tracing needs of a hierarchy, and its entry points by instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

#include "bounds/directions/direction_table.h"
#include "format/view.h"
#include "sobb/sobb.h"

namespace sobb {

// What a traversal reads, whatever the nodes' volumes are. Borrowed.
struct TraceScene {
  DirectionTable directions;
  float centre[3];
  float radius;
  const void* nodes;
  const TriangleBlock* blocks;
};

// Prepared once a hierarchy; borrowed from its image.
struct Tracer : TraceScene {
  uint32_t width;
  bool frame_only;  // all nodes are along the table's first three directions

  explicit Tracer(const FileView& view);
};

inline constexpr int kPacketSize = 16;

// Rays of a batch, at most: enough for long lists, few enough for a cache of the second level.
inline constexpr uint32_t kBatchRays = 2048;

// Ways to trace an array of rays, each of which is the fastest for some.
enum ArrayWay : uint8_t {
  kBatchWay,   // up to kBatchRays together, which share nodes (stream-inl.h)
  kWaveWay,    // each on a way of its own, in turns that hide what memory takes (wave-inl.h)
  kPacketWay,  // 64 neighbours together (packet-inl.h)
  kArrayWays,
};

// The kernels of one instruction set. Each returns how many rays were not valid. `counts` may be
// null.
struct TraceKernels {
  template <class Result>
  using Array = uint64_t (*)(const Tracer& tracer, const sobb_ray* rays, uint64_t count,
                             Result* results, void* scratch);

  // By ArrayWay, for up to kBatchRays rays, with `scratch_bytes` of memory, aligned to 64, of which
  // kPacketWay needs none.
  size_t scratch_bytes;
  Array<sobb_hit> intersect_array[kArrayWays];
  Array<uint8_t> occluded_array[kArrayWays];
  // Ray by ray.
  uint64_t (*intersect)(const Tracer& tracer, const sobb_ray* rays, uint64_t count, sobb_hit* hits,
                        sobb_count* counts);
  uint64_t (*occluded)(const Tracer& tracer, const sobb_ray* rays, uint64_t count,
                       uint8_t* occluded, sobb_count* counts);
  // A packet: bit i of `mask`, below kPacketSize, is for ray i.
  uint64_t (*intersect_packet)(const Tracer& tracer, const sobb_ray* rays, uint32_t mask,
                               sobb_hit* hits);
  uint64_t (*occluded_packet)(const Tracer& tracer, const sobb_ray* rays, uint32_t mask,
                              uint8_t* occluded);
};

const TraceKernels& trace_kernels(sobb_isa isa);

}  // namespace sobb
