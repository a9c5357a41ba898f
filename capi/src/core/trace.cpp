// SPDX-License-Identifier: Apache-2.0
// Tracing: arrays, packets, single rays, and the oracle.
#include <atomic>

#include "../guard.h"
#include "base/isa.h"
#include "base/scheduler.h"
#include "base/scratch_pool.h"
#include "hierarchy.h"
#include "trace/oracle.h"
#include "trace/schedule/array_tracer.h"

using sobb::guard;
using sobb::kPacketSize;
using sobb::require;

namespace {

sobb_trace_options read_trace_options(const sobb_trace_options* options) {
  const sobb_trace_options known = sobb::read_options(options, "trace options");
  if ((known.flags & ~static_cast<uint32_t>(SOBB_TRACE_COHERENT)) != 0) {
    sobb::fail(SOBB_ERROR_INVALID_ARGUMENT, "trace options: flags are %#x", known.flags);
  }
  return known;
}

// Checks the arguments of an array call, shares the array among threads, adds up the invalid rays.
template <class Result>
void trace_array(const sobb_hierarchy* hierarchy, const sobb_ray* rays, uint64_t count,
                 Result* results, const sobb_trace_options* options) {
  require(hierarchy, "hierarchy");
  const sobb_trace_options known = read_trace_options(options);
  const sobb::TraceKernels& kernels = sobb::trace_kernels(sobb::resolve_isa(known.isa));
  if (count != 0) {
    require(rays, "rays");
    require(results, "results");
  }
  const bool coherent = (known.flags & SOBB_TRACE_COHERENT) != 0;
  using Tracer = sobb::ArrayTracer<Result>;
  sobb::ScratchPool pool(*hierarchy->memory, Tracer::scratch_bytes(kernels));
  Tracer tracer(hierarchy->tracer, kernels, coherent, pool);
  const sobb::Scheduler scheduler(known.threads, known.scheduler);
  std::atomic<uint64_t> invalid{0};
  scheduler.for_ranges(count, sobb::kBatchRays, [&](uint64_t begin, uint64_t end) {
    if (known.counts != nullptr) {
      invalid += tracer.count(rays + begin, end - begin, results + begin, known.counts + begin);
    } else {
      invalid += tracer.trace(begin / sobb::kBatchRays, rays + begin, end - begin, results + begin);
    }
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
