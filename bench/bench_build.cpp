// SPDX-License-Identifier: Apache-2.0
// The rows build/METHOD measure the way from triangles to a hierarchy.
#include <memory>

#include "rows.h"

namespace sobb::bench {
namespace {

using benchmark::Counter;

void build_subject(benchmark::State& state, const Workbench& workbench, Method method) {
  double topology_ms = 0, collapse_ms = 0, volume_ms = 0;
  sobb_info info{};
  for ([[maybe_unused]] auto _ : state) {
    const SobbSubject subject(workbench.scene(), method, workbench.flags(),
                              workbench.flags().threads);
    state.SetIterationTime(subject.build_seconds());
    info = subject.info();
    topology_ms += info.topology_ms;
    collapse_ms += info.collapse_ms;
    volume_ms += info.volume_ms;
  }
  state.counters["topology_ms"] = Counter(topology_ms, Counter::kAvgIterations);
  state.counters["collapse_ms"] = Counter(collapse_ms, Counter::kAvgIterations);
  state.counters["volume_ms"] = Counter(volume_ms, Counter::kAvgIterations);
  state.counters["bytes/triangle"] = workbench.per_triangle(info.bytes);
  state.counters["area_inner"] = info.inner_area;
  state.counters["area_leaf"] = info.leaf_area;
}

void build_peer(benchmark::State& state, const Workbench& workbench, Method method) {
  uint64_t bytes = 0;
  for ([[maybe_unused]] auto _ : state) {
    const std::unique_ptr<Peer> peer(peer_library()->make(
        workbench.scene(), method, workbench.flags(), workbench.flags().threads));
    state.SetIterationTime(peer->build_seconds());
    bytes = peer->bytes();
  }
  state.counters["bytes/triangle"] = workbench.per_triangle(bytes);
}

}  // namespace

void register_build_rows(Workbench& workbench) {
  for (const Method method : kMethods) {
    if (is_peer(method) && peer_library() == nullptr) continue;
    register_row("build/" + name_of(method), [&workbench, method](benchmark::State& state) {
      (is_peer(method) ? build_peer : build_subject)(state, workbench, method);
    });
  }
}

}  // namespace sobb::bench
