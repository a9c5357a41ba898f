// SPDX-License-Identifier: Apache-2.0
// SobbSubject is the library under test: one hierarchy, built, saved and traced through the C ABI.
#pragma once

#include <memory>
#include <string>

#include "flags.h"
#include "ray_sets.h"
#include "scene_input.h"
#include "stopwatch.h"
#include "trace_output.h"
#include "workers.h"

namespace sobb::bench {

/// What a ray tests in the single-ray kernel, as means over a set.
struct WorkPerRay {
  double nodes = 0;
  double volumes = 0;
  double blocks = 0;
  double triangles = 0;
};

class SobbSubject {
 public:
  /// Builds with @p build_threads; 0 for all.
  SobbSubject(const SceneInput& scene, Method method, const Flags& flags, uint32_t build_threads);

  Method method() const { return method_; }
  double build_seconds() const { return build_seconds_; }
  sobb_info info() const;
  void save(const std::string& path) const;

  /// Traces the set into @p output, which has room, and returns the seconds that it took.
  double trace(const RaySet& set, Call call, Workers& workers, TraceOutput& output) const;

  /// Traces as trace() does with one ray per call, but each ray a second time right after the
  /// first: what it needs is in the caches then.
  double trace_twice(const RaySet& set, Workers& workers, TraceOutput& output) const;

  WorkPerRay count_work(const RaySet& set) const;

 private:
  template <int kTimes>
  void trace_single(const RaySet& set, Workers& workers, TraceOutput& output) const;
  void trace_packet(const RaySet& set, Workers& workers, TraceOutput& output) const;
  void trace_array(const RaySet& set, TraceOutput& output) const;

  Method method_;
  uint32_t threads_;
  Stopwatch clock_;
  double build_seconds_ = 0;
  std::unique_ptr<sobb_hierarchy, decltype(&sobb_release)> hierarchy_{nullptr, sobb_release};
};

}  // namespace sobb::bench
