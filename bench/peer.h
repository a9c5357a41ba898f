// SPDX-License-Identifier: Apache-2.0
// The library's peer, Embree, as sobb_bench sees it. The code that calls Embree lies in a module of
// its own, sobb_bench_embree, so that the program starts where Embree is not installed.
#pragma once

#include <cstdint>
#include <memory>

#include "flags.h"
#include "scene_input.h"
#include "trace_output.h"
#include "workers.h"

namespace sobb::bench {

/// A hierarchy of the peer's own over the same triangles.
class Peer {
 public:
  Peer() = default;
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  virtual ~Peer() = default;

  virtual double build_seconds() const = 0;
  /// What it holds after the build. The vertices and indices that it shares are not in it.
  virtual uint64_t bytes() const = 0;

  /// Fills the peer's layout of rays for this set and call, which a pass overwrites with hits.
  virtual void load(const RaySet& set, Call call) = 0;
  /// Traces what load() has filled in; returns the seconds that it took.
  virtual double trace(const RaySet& set, Call call, Workers& workers) = 0;
  /// What the last pass found.
  virtual void read(const RaySet& set, Call call, TraceOutput& output) const = 0;
};

struct PeerLibrary {
  const char* version;
  bool has_array_call;
  /// Builds with so many threads (0: all). The caller deletes it.
  Peer* (*make)(const SceneInput& scene, Method method, const Flags& flags, uint32_t threads);
};

/// Null where the module, or Embree below it, is not installed.
const PeerLibrary* peer_library();

/// Why peer_library() is null, in the system's words.
const char* why_no_peer();

}  // namespace sobb::bench
