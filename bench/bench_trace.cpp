// SPDX-License-Identifier: Apache-2.0
// Rows KIND/METHOD/CALL: one pass over a ray set an iteration.
#include "rows.h"

namespace sobb::bench {
namespace {

using benchmark::Counter;

void set_speed(benchmark::State& state, const RaySet& set) {
  const double rays =
      static_cast<double>(state.iterations()) * static_cast<double>(set.rays.size());
  state.counters["Mrays/s"] = Counter(rays / 1e6, Counter::kIsRate);
}

void trace_subject(benchmark::State& state, Workbench& workbench, RayKind kind, Method method,
                   Call call) {
  const RaySet& set = workbench.rays(kind);
  const SobbSubject& subject = workbench.subject(method);
  TraceOutput& output = workbench.output();
  output.resize(set);
  for ([[maybe_unused]] auto _ : state) {
    state.SetIterationTime(subject.trace(set, call, workbench.workers(), output));
  }
  set_speed(state, set);
  if (call == Call::kSingle) {  // the kernel that counts is the single-ray one
    const WorkPerRay work = workbench.work(kind, method);
    state.counters["nodes/ray"] = work.nodes;
    state.counters["volumes/ray"] = work.volumes;
    state.counters["blocks/ray"] = work.blocks;
    state.counters["triangles/ray"] = work.triangles;
  }
}

void trace_peer(benchmark::State& state, Workbench& workbench, RayKind kind, Method method,
                Call call) {
  const RaySet& set = workbench.rays(kind);
  const EmbreePeer& peer = workbench.peer(method);
  EmbreeRays& rays = workbench.embree_rays();
  for ([[maybe_unused]] auto _ : state) {
    rays.load(set, call);
    state.SetIterationTime(peer.trace(set, call, workbench.workers(), rays));
  }
  set_speed(state, set);
}

}  // namespace

void register_trace_rows(Workbench& workbench) {
  for (const RayKind kind : kRayKinds) {
    for (const Call call : kCalls) {
      for (const Method method : kSubjects) {
        register_row(row_name(kind, method, call),
                     [&workbench, kind, method, call](benchmark::State& state) {
                       trace_subject(state, workbench, kind, method, call);
                     });
      }
      if (call == Call::kArray && !kEmbreeHasArrayCall) continue;
      for (const Method method : kPeers) {
        register_row(row_name(kind, method, call),
                     [&workbench, kind, method, call](benchmark::State& state) {
                       trace_peer(state, workbench, kind, method, call);
                     });
      }
    }
  }
}

}  // namespace sobb::bench
