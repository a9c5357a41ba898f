// SPDX-License-Identifier: Apache-2.0
// EmbreePeer is the library's peer: Embree's own hierarchy over the same triangles.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "embree_calls.h"
#include "embree_rays.h"
#include "flags.h"
#include "scene_input.h"
#include "stopwatch.h"
#include "workers.h"

namespace sobb::bench {

class EmbreePeer {
 public:
  /// Builds with @p build_threads (0: all); the clock runs over the commit of geometry and scene,
  /// not over making the device.
  EmbreePeer(const SceneInput& scene, Method method, const Flags& flags, uint32_t build_threads);

  Method method() const { return method_; }
  double build_seconds() const { return build_seconds_; }
  /// What Embree holds after the commit. The vertices and indices that it shares are not in it.
  uint64_t bytes() const { return static_cast<uint64_t>(bytes_.load()); }

  /// Traces what @p rays has loaded for this set and call; returns the seconds that it took.
  double trace(const RaySet& set, Call call, Workers& workers, EmbreeRays& rays) const;

 private:
  template <typename Ray>
  void trace_single(std::vector<Ray>& rays, bool coherent, Workers& workers) const;
  template <typename Packet>
  void trace_packet(std::vector<Packet>& packets, const int* last_valid, bool coherent,
                    Workers& workers) const;
  template <typename Ray>
  void trace_array(std::vector<Ray>& rays, bool coherent, Workers& workers) const;

  void build(const SceneInput& input);

  Method method_;
  Stopwatch clock_;
  double build_seconds_ = 0;
  // The device reports every allocation to it, so it outlives device and scene.
  std::atomic<int64_t> bytes_ = 0;
  std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device_;
  std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)> scene_;
};

}  // namespace sobb::bench
