// SPDX-License-Identifier: Apache-2.0
// What tracing needs of a hierarchy, and its entry points by instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

#include "bounds/direction_table.h"
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

// The kernels of one instruction set. Each returns how many rays were not valid. `counts` may be
// null.
struct TraceKernels {
  // Two ways for an array of rays that need not be coherent, each with `scratch_bytes` of memory,
  // aligned to 64: in a batch, at most kBatchRays, which shares nodes (stream-inl.h), and in a
  // wave, which hides what memory takes (wave-inl.h).
  size_t scratch_bytes;
  uint64_t (*intersect_batch)(const Tracer& tracer, const sobb_ray* rays, uint64_t count,
                              sobb_hit* hits, void* scratch);
  uint64_t (*occluded_batch)(const Tracer& tracer, const sobb_ray* rays, uint64_t count,
                             uint8_t* occluded, void* scratch);
  uint64_t (*intersect_wave)(const Tracer& tracer, const sobb_ray* rays, uint64_t count,
                             sobb_hit* hits, void* scratch);
  uint64_t (*occluded_wave)(const Tracer& tracer, const sobb_ray* rays, uint64_t count,
                            uint8_t* occluded, void* scratch);
  // Ray by ray.
  uint64_t (*intersect)(const Tracer& tracer, const sobb_ray* rays, uint64_t count, sobb_hit* hits,
                        sobb_count* counts);
  uint64_t (*occluded)(const Tracer& tracer, const sobb_ray* rays, uint64_t count,
                       uint8_t* occluded, sobb_count* counts);
  // An array of rays of which neighbours take much the same way.
  uint64_t (*intersect_coherent)(const Tracer& tracer, const sobb_ray* rays, uint64_t count,
                                 sobb_hit* hits);
  uint64_t (*occluded_coherent)(const Tracer& tracer, const sobb_ray* rays, uint64_t count,
                                uint8_t* occluded);
  // A packet: bit i of `mask`, below kPacketSize, is for ray i.
  uint64_t (*intersect_packet)(const Tracer& tracer, const sobb_ray* rays, uint32_t mask,
                               sobb_hit* hits);
  uint64_t (*occluded_packet)(const Tracer& tracer, const sobb_ray* rays, uint32_t mask,
                              uint8_t* occluded);
};

const TraceKernels& trace_kernels(sobb_isa isa);

}  // namespace sobb
