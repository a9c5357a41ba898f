// SPDX-License-Identifier: Apache-2.0
// Rows build/METHOD: from triangles to a hierarchy.
#include "rows.h"

namespace sobb::bench {
namespace {

using benchmark::Counter;

Counter per_triangle(uint64_t bytes, const Workbench& workbench) {
  return static_cast<double>(bytes) / static_cast<double>(workbench.scene().info().triangle_count);
}

void build_subject(benchmark::State& state, const Workbench& workbench, Method method) {
  double topology_ms = 0, collapse_ms = 0, volume_ms = 0;
  sobb_info info{};
  for ([[maybe_unused]] auto _ : state) {
    const SobbSubject subject(workbench.scene(), method, workbench.flags());
    state.SetIterationTime(subject.build_seconds());
    info = subject.info();
    topology_ms += info.topology_ms;
    collapse_ms += info.collapse_ms;
    volume_ms += info.volume_ms;
  }
  state.counters["topology_ms"] = Counter(topology_ms, Counter::kAvgIterations);
  state.counters["collapse_ms"] = Counter(collapse_ms, Counter::kAvgIterations);
  state.counters["volume_ms"] = Counter(volume_ms, Counter::kAvgIterations);
  state.counters["bytes/triangle"] = per_triangle(info.bytes, workbench);
  state.counters["area_inner"] = info.inner_area;
  state.counters["area_leaf"] = info.leaf_area;
}

void build_peer(benchmark::State& state, const Workbench& workbench, Method method) {
  uint64_t bytes = 0;
  for ([[maybe_unused]] auto _ : state) {
    const EmbreePeer peer(workbench.scene(), method, workbench.flags());
    state.SetIterationTime(peer.build_seconds());
    bytes = peer.bytes();
  }
  state.counters["bytes/triangle"] = per_triangle(bytes, workbench);
}

}  // namespace

void register_build_rows(Workbench& workbench) {
  for (const Method method : kSubjects) {
    register_row("build/" + name_of(method), [&workbench, method](benchmark::State& state) {
      build_subject(state, workbench, method);
    });
  }
  for (const Method method : kPeers) {
    register_row("build/" + name_of(method), [&workbench, method](benchmark::State& state) {
      build_peer(state, workbench, method);
    });
  }
}

}  // namespace sobb::bench
