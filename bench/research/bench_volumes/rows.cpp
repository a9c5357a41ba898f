// SPDX-License-Identifier: Apache-2.0
// The bodies of the rows. Google Benchmark does not tell a body which repetition it runs, so the
// rows that report earlier measurements count by themselves.
#include "bench_volumes/rows.h"

#include <benchmark/benchmark.h>

#include "bench_volumes/repetitions.h"
#include "register_row.h"

namespace sobb::bench::volumes {
namespace {

using benchmark::Counter;
using benchmark::State;

void report_build(State& state, const Workbench& workbench, uint32_t width, size_t repetition) {
  const auto& samples = workbench.topology_times();
  const TopologyTimes& times = samples[repetition % samples.size()];
  const double convert_ms = workbench.boxes(width).hierarchy.convert_ms();
  for ([[maybe_unused]] auto _ : state) {
    state.SetIterationTime(1e-3 * (times.topology + times.layout_of(width) + convert_ms));
  }
  const study::SharedTopology& topology = workbench.topology();
  state.counters["topology_ms"] = times.topology;
  state.counters["layout_ms"] = times.layout_of(width);
  state.counters["convert_ms"] = convert_ms;
  state.counters["depth"] = topology.depth(width);
  state.counters["nodes"] = static_cast<double>(topology.node_count(width));
  state.counters["leaves"] = static_cast<double>(topology.leaf_count());
}

void report_overhead(State& state, const Workbench& workbench, const Subject& subject, bool first) {
  for ([[maybe_unused]] auto _ : state) {
    const double ms = first ? subject.hierarchy.convert_ms() : workbench.convert_anew(subject);
    state.SetIterationTime(1e-3 * ms);
  }
  state.counters["area_inner"] = subject.areas.inner;
  state.counters["area_leaf"] = subject.areas.leaf;
  state.counters["node_bytes"] = static_cast<double>(subject.hierarchy.node_bytes());
}

void trace(State& state, Workbench& workbench, const Subject& subject, const RayGroup& group,
           const Work& work) {
  for ([[maybe_unused]] auto _ : state) state.SetIterationTime(workbench.trace(subject, group));
  const double rays =
      static_cast<double>(state.iterations()) * static_cast<double>(group.rays.size());
  state.counters["Mrays/s"] = Counter(rays / 1e6, Counter::kIsRate);
  state.counters["nodes/ray"] = work.nodes;
  state.counters["volumes/ray"] = work.volumes;
  state.counters["triangles/ray"] = work.triangles;
}

}  // namespace

void register_build_rows(Workbench& workbench) {
  for (const uint32_t width : workbench.options().widths) {
    const auto next = std::make_shared<size_t>(0);
    register_row("build/" + layout_name(width),
                 [&workbench, width, next](State& state) {
                   report_build(state, workbench, width, (*next)++);
                 })
        ->Repetitions(static_cast<int>(workbench.topology_times().size()))
        ->Iterations(1);
  }
}

void register_overhead_rows(Workbench& workbench) {
  for (const Subject& subject : workbench.subjects()) {
    const double seconds = 1e-3 * subject.hierarchy.convert_ms();
    const auto next = std::make_shared<size_t>(0);
    register_row("overhead/" + subject.name(),
                 [&workbench, &subject, next](State& state) {
                   report_overhead(state, workbench, subject, (*next)++ == 0);
                 })
        ->Repetitions(repetitions(workbench.options().cell_seconds, seconds, kFewestBuilds).count)
        ->Iterations(1);
  }
}

void register_trace_rows(Workbench& workbench) {
  for (size_t i = 0; i < kGroups; ++i) {
    const RayGroup& group = workbench.groups()[i];
    for (const Subject& subject : workbench.subjects()) {
      const Work& work = subject.work[i];
      const Repetitions often =
          repetitions(workbench.options().cell_seconds, work.seconds, kFewestPasses);
      register_row(group.name + "/" + subject.name(),
                   [&workbench, &subject, &group, &work](State& state) {
                     trace(state, workbench, subject, group, work);
                   })
          ->Repetitions(often.count)
          ->Iterations(often.passes);
    }
  }
}

}  // namespace sobb::bench::volumes
