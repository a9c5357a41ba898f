// SPDX-License-Identifier: Apache-2.0
// EmbreePeer is the library's peer: Embree's own hierarchy over the same triangles.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "embree_calls.h"
#include "embree_rays.h"
#include "peer.h"
#include "stopwatch.h"

namespace sobb::bench {

class EmbreePeer final : public Peer {
 public:
  /// Builds with @p build_threads (0: all); the clock runs over the commit of geometry and scene,
  /// not over making the device.
  EmbreePeer(const SceneInput& scene, Method method, const Flags& flags, uint32_t build_threads);

  double build_seconds() const override { return build_seconds_; }
  uint64_t bytes() const override { return static_cast<uint64_t>(bytes_.load()); }

  void load(const RaySet& set, Call call) override { rays().load(set, call); }
  double trace(const RaySet& set, Call call, Workers& workers) override;
  void read(const RaySet& set, Call call, TraceOutput& output) const override {
    rays().read(set, call, output);
  }

 private:
  template <typename Ray>
  void trace_single(std::vector<Ray>& rays, bool coherent, Workers& workers) const;
  template <typename Packet>
  void trace_packet(std::vector<Packet>& packets, const int* last_valid, bool coherent,
                    Workers& workers) const;
  template <typename Ray>
  void trace_array(std::vector<Ray>& rays, bool coherent, Workers& workers) const;

  void build(const SceneInput& input);
  /// All peers use the same buffers: their pages are touched once.
  static EmbreeRays& rays();

  Method method_;
  Stopwatch clock_;
  double build_seconds_ = 0;
  // The device reports every allocation to it, so it outlives device and scene.
  std::atomic<int64_t> bytes_ = 0;
  std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device_;
  std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)> scene_;
};

}  // namespace sobb::bench
