// SPDX-License-Identifier: Apache-2.0
// The tasks of one array of rays, each traced in what the call has found to be the fastest way.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "base/scratch_pool.h"
#include "trace/schedule/dealt_rays.h"
#include "trace/schedule/fastest_mode.h"
#include "trace/trace.h"

namespace sobb {

// The kernels of a query, and the way that is likely to be the fastest.
template <class Result>
struct ArrayKernels {
  uint64_t (*single)(const Tracer&, const sobb_ray*, uint64_t, Result*, sobb_count*);
  const TraceKernels::Array<Result>* by_way;
  ArrayWay likely;
};

// Rays that look for the closest hit mostly go ways of their own; those that look for any end
// where they began, or at a light.
inline ArrayKernels<sobb_hit> array_kernels(const TraceKernels& kernels, const sobb_hit*) {
  return {kernels.intersect, kernels.intersect_array, kWaveWay};
}
inline ArrayKernels<uint8_t> array_kernels(const TraceKernels& kernels, const uint8_t*) {
  return {kernels.occluded, kernels.occluded_array, kBatchWay};
}

// Borrows all that it is given. Thread-safe.
template <class Result>
class ArrayTracer {
 public:
  // `coherent`: neighbours are said to be alike. The pool's blocks have scratch_bytes().
  ArrayTracer(const Tracer& tracer, const TraceKernels& kernels, bool coherent, ScratchPool& pool)
      : tracer_(tracer),
        kernel_bytes_(kernel_bytes(kernels)),
        kernels_(array_kernels(kernels, static_cast<const Result*>(nullptr))),
        coherent_(coherent),
        pool_(pool),
        fastest_(coherent ? kAlike : kAll, coherent ? kPacketWay : kernels_.likely) {}

  static size_t scratch_bytes(const TraceKernels& kernels) {
    return kernel_bytes(kernels) + sizeof(Dealt);
  }

  // Traces a task's rays, at most kBatchRays. Returns how many were not valid.
  uint64_t trace(uint64_t task, const sobb_ray* rays, uint64_t count, Result* results) {
    if (count >= kFewestTogether) {
      const ScratchPool::Lease lease(pool_);
      if (lease.get() != nullptr) return together(task, rays, count, results, lease.get());
    }
    if (coherent_) return kernels_.by_way[kPacketWay](tracer_, rays, count, results, nullptr);
    return kernels_.single(tracer_, rays, count, results, nullptr);
  }

  // Likewise, ray by ray, and says what each took.
  uint64_t count(const sobb_ray* rays, uint64_t count, Result* results, sobb_count* counts) const {
    return kernels_.single(tracer_, rays, count, results, counts);
  }

 private:
  using Fastest = FastestWay<kArrayWays>;
  using Dealt = DealtRays<Result>;

  static size_t kernel_bytes(const TraceKernels& kernels) {
    return (kernels.scratch_bytes + 63) / 64 * 64;
  }

  static constexpr uint32_t kAll = (1U << kArrayWays) - 1;
  static constexpr uint32_t kAlike = kAll & ~(1U << kWaveWay);  // rays that are alike share nodes
  // Fewer rays are not worth the memory that tracing them together takes.
  static constexpr uint64_t kFewestTogether = 256;
  // Runs of a task that tell what a way takes. Batches are the faster the larger they are.
  static uint32_t compared(size_t way, bool behind) {
    if (way == kBatchWay) return behind ? Dealt::kRuns / 8 : Dealt::kRuns / 2;
    return behind ? Dealt::kRuns / 16 : Dealt::kRuns / 8;
  }

  uint64_t together(uint64_t task, const sobb_ray* rays, uint64_t count, Result* results,
                    void* scratch) {
    const typename Fastest::Turn turn = fastest_.turn(task);
    if (turn.compares && count == kBatchRays) return compare(task, turn, rays, results, scratch);
    return kernels_.by_way[turn.best](tracer_, rays, count, results, scratch);
  }

  uint64_t compare(uint64_t task, const typename Fastest::Turn& turn, const sobb_ray* rays,
                   Result* results, void* scratch) {
    uint32_t runs[kArrayWays] = {};
    runs[turn.best] = Dealt::kRuns;
    for (size_t way = 0; way < kArrayWays; ++way) {
      if (way == turn.best || !fastest_.has(way)) continue;
      runs[way] = compared(way, (turn.behind >> way & 1) != 0);
      runs[turn.best] -= runs[way];
    }
    auto& dealt = *new (static_cast<uint8_t*>(scratch) + kernel_bytes_) Dealt;
    dealt.deal(rays, runs);
    float time[kArrayWays] = {};
    uint64_t invalid = 0;
    for (size_t i = 0; i < kArrayWays; ++i) {
      // Each has its turn to be the first, which finds the caches cold.
      const size_t way = (task + i) % kArrayWays;
      if (runs[way] == 0) continue;
      const uint64_t share = uint64_t{runs[way]} * Dealt::kRun;
      const auto start = std::chrono::steady_clock::now();
      invalid += kernels_.by_way[way](tracer_, dealt.rays(way), share, dealt.results(way), scratch);
      const std::chrono::duration<float> took = std::chrono::steady_clock::now() - start;
      time[way] = took.count() / static_cast<float>(share);
    }
    dealt.collect(results);
    fastest_.took(time);
    return invalid;
  }

  const Tracer& tracer_;
  const size_t kernel_bytes_;
  const ArrayKernels<Result> kernels_;
  const bool coherent_;
  ScratchPool& pool_;
  Fastest fastest_;
};

}  // namespace sobb
