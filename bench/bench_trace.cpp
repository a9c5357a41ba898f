// SPDX-License-Identifier: Apache-2.0
// The rows KIND/METHOD/CALL make one pass over a ray set per iteration.
#include <algorithm>

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
  const SobbSubject& subject = workbench.subject(method);
  const RaySet& set = workbench.rays(kind);
  TraceOutput& output = workbench.output();
  output.resize(set);
  for ([[maybe_unused]] auto _ : state) {
    state.SetIterationTime(subject.trace(set, call, workbench.workers(), output));
  }
  set_speed(state, set);
  state.counters["bytes/triangle"] = workbench.per_triangle(subject.info().bytes);
  if (call == Call::kSingle) {  // the single-ray kernel is the one that counts
    const WorkPerRay work = workbench.work(kind, method);
    state.counters["nodes/ray"] = work.nodes;
    state.counters["volumes/ray"] = work.volumes;
    state.counters["blocks/ray"] = work.blocks;
    state.counters["triangles/ray"] = work.triangles;
  }
}

// A clock around every ray would cost as much as the ray. So the replays take the time of a pass
// with them minus that of a pass without.
void replay_subject(benchmark::State& state, Workbench& workbench, RayKind kind, Method method) {
  const SobbSubject& subject = workbench.subject(method);
  const RaySet& set = workbench.rays(kind);
  TraceOutput& output = workbench.output();
  output.resize(set);
  double once = 0, replays = 0;
  for ([[maybe_unused]] auto _ : state) {
    const double real = subject.trace(set, Call::kSingle, workbench.workers(), output);
    const double both = subject.trace_twice(set, workbench.workers(), output);
    state.SetIterationTime(std::max(both - real, 0.0));  // noise alone makes it negative
    once += real;
    replays += both - real;
  }
  set_speed(state, set);
  state.counters["replay_ratio"] = replays / once;
}

void trace_peer(benchmark::State& state, Workbench& workbench, RayKind kind, Method method,
                Call call) {
  Peer& peer = workbench.peer(method);
  const RaySet& set = workbench.rays(kind);
  for ([[maybe_unused]] auto _ : state) {
    peer.load(set, call);
    state.SetIterationTime(peer.trace(set, call, workbench.workers()));
  }
  set_speed(state, set);
  state.counters["bytes/triangle"] = workbench.per_triangle(peer.bytes());
}

bool peer_has(Call call) {
  const PeerLibrary* library = peer_library();
  return library != nullptr && (call != Call::kArray || library->has_array_call);
}

}  // namespace

void register_trace_rows(Workbench& workbench) {
  for (const RayKind kind : kRayKinds) {
    for (const Method method : kMethods) {
      for (const Call call : kCalls) {
        if (is_peer(method) && !peer_has(call)) continue;
        register_row(row_name(kind, method, call), [&workbench, kind, method,
                                                    call](benchmark::State& state) {
          (is_peer(method) ? trace_peer : trace_subject)(state, workbench, kind, method, call);
        });
      }
      if (is_peer(method)) continue;
      register_row(name_of(kind) + "/" + name_of(method) + "/replay",
                   [&workbench, kind, method](benchmark::State& state) {
                     replay_subject(state, workbench, kind, method);
                   });
    }
  }
}

}  // namespace sobb::bench
