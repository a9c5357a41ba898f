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

// Prepared once per hierarchy; borrowed from its image.
struct Tracer : TraceScene {
  uint32_t width;
  bool frame_only;  // all nodes are along the frame, the table's first three directions

  explicit Tracer(const FileView& view);
};

inline constexpr int kPacketSize = 16;

// The most rays of a batch: enough for long lists, few enough for a cache of the second level.
inline constexpr uint32_t kBatchRays = 2048;

// The modes to trace an array of rays in, each of which is the fastest for some.
enum TraceMode : uint8_t {
  kBatchMode,   // up to kBatchRays together, which share nodes (batch/)
  kWaveMode,    // each on a path of its own, in turns that hide memory's latency (wave/)
  kPacketMode,  // 64 neighbours together (packet/)
  kTraceModes,
};

// The kernels of one instruction set. Each returns how many rays were not valid. `counts` may be
// null.
struct TraceKernels {
  template <class Result>
  using Array = uint64_t (*)(const Tracer& tracer, const sobb_ray* rays, uint64_t count,
                             Result* results, void* scratch);

  // Array kernels by TraceMode, for up to kBatchRays rays, with `scratch_bytes` of memory, aligned
  // to 64, of which kPacketMode needs none.
  size_t scratch_bytes;
  Array<sobb_hit> intersect_array[kTraceModes];
  Array<uint8_t> occluded_array[kTraceModes];
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
