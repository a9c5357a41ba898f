// SPDX-License-Identifier: Apache-2.0
// Traces the tasks of one array of rays, each in the mode that the call has found to be the
// fastest.
//
// The room schedule/ chooses among the modes while an array is traced: fastest_mode.h remembers
// what each took, dealt_rays.h lets them be compared fairly. It knows the kernels by trace.h alone.
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

// The kernels of a query, and the mode that is likely to be the fastest.
template <class Result>
struct ArrayKernels {
  uint64_t (*single)(const Tracer&, const sobb_ray*, uint64_t, Result*, sobb_count*);
  const TraceKernels::Array<Result>* by_mode;
  TraceMode likely;
};

// Rays that look for their closest hit mostly diverge; occlusion rays begin or end near each other,
// at a surface or a light.
inline ArrayKernels<sobb_hit> array_kernels(const TraceKernels& kernels, const sobb_hit*) {
  return {kernels.intersect, kernels.intersect_array, kWaveMode};
}
inline ArrayKernels<uint8_t> array_kernels(const TraceKernels& kernels, const uint8_t*) {
  return {kernels.occluded, kernels.occluded_array, kBatchMode};
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
        fastest_(coherent ? kAlike : kAll, coherent ? kPacketMode : kernels_.likely) {}

  static size_t scratch_bytes(const TraceKernels& kernels) {
    return kernel_bytes(kernels) + sizeof(Dealt);
  }

  // Traces a task's rays, at most kBatchRays. Returns how many were not valid.
  uint64_t trace(uint64_t task, const sobb_ray* rays, uint64_t count, Result* results) {
    if (count >= kFewestTogether) {
      const ScratchPool::Lease lease(pool_);
      if (lease.get() != nullptr) return together(task, rays, count, results, lease.get());
    }
    if (coherent_) return kernels_.by_mode[kPacketMode](tracer_, rays, count, results, nullptr);
    return kernels_.single(tracer_, rays, count, results, nullptr);
  }

  // Traces a task ray by ray, and says what each took.
  uint64_t count(const sobb_ray* rays, uint64_t count, Result* results, sobb_count* counts) const {
    return kernels_.single(tracer_, rays, count, results, counts);
  }

 private:
  using Fastest = FastestMode<kTraceModes>;
  using Dealt = DealtRays<Result>;

  static size_t kernel_bytes(const TraceKernels& kernels) {
    return (kernels.scratch_bytes + 63) / 64 * 64;
  }

  static constexpr uint32_t kAll = (1U << kTraceModes) - 1;
  static constexpr uint32_t kAlike = kAll & ~(1U << kWaveMode);  // rays that are alike share nodes
  // Fewer rays are not worth the memory that tracing them together takes.
  static constexpr uint64_t kFewestTogether = 256;
  // How many runs of a task measure a mode that is not the best. Batches are the faster the larger
  // they are.
  static uint32_t compared(size_t mode, bool behind) {
    if (mode == kBatchMode) return behind ? Dealt::kRuns / 8 : Dealt::kRuns / 2;
    return behind ? Dealt::kRuns / 16 : Dealt::kRuns / 8;
  }

  uint64_t together(uint64_t task, const sobb_ray* rays, uint64_t count, Result* results,
                    void* scratch) {
    const typename Fastest::Turn turn = fastest_.turn(task);
    if (turn.compares && count == kBatchRays) return compare(task, turn, rays, results, scratch);
    return kernels_.by_mode[turn.best](tracer_, rays, count, results, scratch);
  }

  uint64_t compare(uint64_t task, const typename Fastest::Turn& turn, const sobb_ray* rays,
                   Result* results, void* scratch) {
    uint32_t runs[kTraceModes] = {};
    runs[turn.best] = Dealt::kRuns;
    for (size_t mode = 0; mode < kTraceModes; ++mode) {
      if (mode == turn.best || !fastest_.has(mode)) continue;
      runs[mode] = compared(mode, (turn.behind >> mode & 1) != 0);
      runs[turn.best] -= runs[mode];
    }
    auto& dealt = *new (static_cast<uint8_t*>(scratch) + kernel_bytes_) Dealt;
    dealt.deal(rays, runs);
    float time[kTraceModes] = {};
    uint64_t invalid = 0;
    for (size_t i = 0; i < kTraceModes; ++i) {
      // Each mode has its turn to be the first, which finds the caches cold.
      const size_t mode = (task + i) % kTraceModes;
      if (runs[mode] == 0) continue;
      const uint64_t share = uint64_t{runs[mode]} * Dealt::kRun;
      const auto start = std::chrono::steady_clock::now();
      invalid +=
          kernels_.by_mode[mode](tracer_, dealt.rays(mode), share, dealt.results(mode), scratch);
      const std::chrono::duration<float> took = std::chrono::steady_clock::now() - start;
      time[mode] = took.count() / static_cast<float>(share);
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
