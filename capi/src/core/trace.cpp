// SPDX-License-Identifier: Apache-2.0
// Tracing: arrays, packets, single rays, and the oracle.
#include <algorithm>
#include <atomic>
#include <chrono>

#include "../guard.h"
#include "base/isa.h"
#include "base/scheduler.h"
#include "base/scratch_pool.h"
#include "hierarchy.h"
#include "trace/fastest_way.h"
#include "trace/oracle.h"

using sobb::guard;
using sobb::kPacketSize;
using sobb::require;

namespace {

// Rays a task. A batch is enough to drown its cost, and few enough to balance rays that differ.
constexpr uint64_t kGrain = sobb::kBatchRays;
// Fewer rays are not worth the memory that tracing them together takes.
constexpr uint64_t kFewestTogether = 256;

sobb_trace_options read_trace_options(const sobb_trace_options* options) {
  const sobb_trace_options known = sobb::read_options(options, "trace options");
  if ((known.flags & ~static_cast<uint32_t>(SOBB_TRACE_COHERENT)) != 0) {
    sobb::fail(SOBB_ERROR_INVALID_ARGUMENT, "trace options: flags are %#x", known.flags);
  }
  return known;
}

// The kernels of an array call.
template <class Result>
struct ArrayKernels {
  using Way = uint64_t (*)(const sobb::Tracer&, const sobb_ray*, uint64_t, Result*, void*);

  uint64_t (*single)(const sobb::Tracer&, const sobb_ray*, uint64_t, Result*, sobb_count*);
  uint64_t (*coherent)(const sobb::Tracer&, const sobb_ray*, uint64_t, Result*);
  Way ways[sobb::FastestWay::kWays];
  size_t first_way;
};

// Rays that look for the closest hit mostly go ways of their own; those that look for any end
// where they began, or at a light.
ArrayKernels<sobb_hit> array_kernels(const sobb::TraceKernels& kernels, const sobb_hit*) {
  return {kernels.intersect,
          kernels.intersect_coherent,
          {kernels.intersect_batch, kernels.intersect_wave},
          1};
}

ArrayKernels<uint8_t> array_kernels(const sobb::TraceKernels& kernels, const uint8_t*) {
  return {kernels.occluded,
          kernels.occluded_coherent,
          {kernels.occluded_batch, kernels.occluded_wave},
          0};
}

// Checks the arguments of an array call, shares the array among threads, adds up the invalid rays.
template <class Result>
void trace_array(const sobb_hierarchy* hierarchy, const sobb_ray* rays, uint64_t count,
                 Result* results, const sobb_trace_options* options) {
  require(hierarchy, "hierarchy");
  const sobb_trace_options known = read_trace_options(options);
  const sobb::TraceKernels& all_kernels = sobb::trace_kernels(sobb::resolve_isa(known.isa));
  const auto kernels = array_kernels(all_kernels, results);
  if (count != 0) {
    require(rays, "rays");
    require(results, "results");
  }
  const sobb::Tracer& tracer = hierarchy->tracer;
  const bool coherent = (known.flags & SOBB_TRACE_COHERENT) != 0;
  sobb::ScratchPool pool(*hierarchy->memory, all_kernels.scratch_bytes);
  const sobb::Scheduler scheduler(known.threads, known.scheduler);
  std::atomic<uint64_t> invalid{0};
  sobb::FastestWay fastest(kernels.first_way);
  scheduler.for_ranges(count, kGrain, [&](uint64_t begin, uint64_t end) {
    const uint64_t size = end - begin;
    if (known.counts != nullptr) {
      invalid += kernels.single(tracer, rays + begin, size, results + begin, known.counts + begin);
      return;
    }
    if (coherent) {
      invalid += kernels.coherent(tracer, rays + begin, size, results + begin);
      return;
    }
    if (size >= kFewestTogether) {
      const sobb::ScratchPool::Lease lease(pool);
      if (lease.get() != nullptr) {
        const size_t way = fastest.of_task(begin / kGrain);
        const auto start = std::chrono::steady_clock::now();
        invalid += kernels.ways[way](tracer, rays + begin, size, results + begin, lease.get());
        fastest.took(way, std::chrono::steady_clock::now() - start, size);
        return;
      }
    }
    invalid += kernels.single(tracer, rays + begin, size, results + begin, nullptr);
  });
  if (known.invalid_rays != nullptr) *known.invalid_rays = invalid;
}

void check_packet(const sobb_hierarchy* hierarchy, const void* rays, uint32_t mask,
                  const void* results) {
  require(hierarchy, "hierarchy");
  require(rays, "rays");
  require(results, "results");
  if (mask >> kPacketSize != 0) {
    sobb::fail(SOBB_ERROR_INVALID_ARGUMENT, "mask is %#x, a packet has %d rays", mask, kPacketSize);
  }
}

}  // namespace

extern "C" {

sobb_status sobb_intersect(const sobb_hierarchy* hierarchy, const sobb_ray* rays, uint64_t count,
                           sobb_hit* hits, const sobb_trace_options* options) {
  return guard([&] { trace_array(hierarchy, rays, count, hits, options); });
}

sobb_status sobb_occluded(const sobb_hierarchy* hierarchy, const sobb_ray* rays, uint64_t count,
                          uint8_t* occluded, const sobb_trace_options* options) {
  return guard([&] { trace_array(hierarchy, rays, count, occluded, options); });
}

sobb_status sobb_intersect1(const sobb_hierarchy* hierarchy, const sobb_ray* ray, sobb_hit* hit) {
  return guard([&] {
    check_packet(hierarchy, ray, 1, hit);
    hierarchy->kernels->intersect(hierarchy->tracer, ray, 1, hit, nullptr);
  });
}

sobb_status sobb_occluded1(const sobb_hierarchy* hierarchy, const sobb_ray* ray,
                           uint8_t* occluded) {
  return guard([&] {
    check_packet(hierarchy, ray, 1, occluded);
    hierarchy->kernels->occluded(hierarchy->tracer, ray, 1, occluded, nullptr);
  });
}

sobb_status sobb_intersect_packet(const sobb_hierarchy* hierarchy, const sobb_ray* rays,
                                  uint32_t mask, sobb_hit* hits) {
  return guard([&] {
    check_packet(hierarchy, rays, mask, hits);
    hierarchy->kernels->intersect_packet(hierarchy->tracer, rays, mask, hits);
  });
}

sobb_status sobb_occluded_packet(const sobb_hierarchy* hierarchy, const sobb_ray* rays,
                                 uint32_t mask, uint8_t* occluded) {
  return guard([&] {
    check_packet(hierarchy, rays, mask, occluded);
    hierarchy->kernels->occluded_packet(hierarchy->tracer, rays, mask, occluded);
  });
}

sobb_status sobb_brute_force(const sobb_triangles* triangles, const sobb_ray* rays, uint64_t count,
                             sobb_hit* hits, const sobb_trace_options* options) {
  return guard([&] {
    require(triangles, "triangles");
    if (count != 0) {
      require(rays, "rays");
      require(hits, "hits");
    }
    const sobb_triangles input = sobb::read_options(triangles, "triangles");
    const sobb_trace_options known = read_trace_options(options);
    const sobb::Scheduler scheduler(known.threads, known.scheduler);
    const sobb::Mesh mesh(input, scheduler);
    const uint64_t invalid = sobb::brute_force(mesh, rays, count, hits, scheduler);
    if (known.invalid_rays != nullptr) *known.invalid_rays = invalid;
  });
}

}  // extern "C"
