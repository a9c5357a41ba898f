// SPDX-License-Identifier: Apache-2.0
// The peer builds with Embree and traces as its manual advises: with flush-to-zero, with the
// coherent flag where rays are coherent, with one context per thread.
#include "embree_peer.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include <stdexcept>

namespace sobb::bench {
namespace {

// Sets flush-to-zero and denormals-are-zero while Embree traces.
class FlushDenormals {
 public:
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;
#if defined(__SSE2__)
  FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040u); }
  ~FlushDenormals() { _mm_setcsr(saved_); }

 private:
  unsigned saved_;
#else
  FlushDenormals() = default;
#endif
};

RTCDevice new_device(const Flags& flags, uint32_t threads) {
  std::string config = "threads=" + std::to_string(threads);
  if (!flags.embree_isa.empty()) config += ",isa=" + flags.embree_isa;
  RTCDevice device = rtcNewDevice(config.c_str());
  if (device == nullptr) {
    throw std::runtime_error("Embree refused the device configuration \"" + config + "\"");
  }
  return device;
}

bool count_bytes(void* total, ssize_t bytes, bool /*post*/) {
  *static_cast<std::atomic<int64_t>*>(total) += bytes;
  return true;
}

}  // namespace

EmbreePeer::EmbreePeer(const SceneInput& scene, Method method, const Flags& flags,
                       uint32_t build_threads)
    : method_(method),
      clock_(flags.threads),
      device_(new_device(flags, build_threads), rtcReleaseDevice),
      scene_(nullptr, rtcReleaseScene) {
  rtcSetDeviceMemoryMonitorFunction(device_.get(), count_bytes, &bytes_);
  build_seconds_ = clock_.seconds_of([&] { build(scene); });
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) {
    throw std::runtime_error("Embree failed to build the scene");
  }
}

void EmbreePeer::build(const SceneInput& input) {
  const sobb_triangles& triangles = input.triangles();
  scene_.reset(rtcNewScene(device_.get()));
  rtcSetSceneBuildQuality(scene_.get(),
                          is_high(method_) ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
  rtcSetSceneFlags(scene_.get(), is_robust(method_) ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             triangles.vertices, 0, triangles.vertex_stride,
                             triangles.vertex_count);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             triangles.indices, 0, 12, triangles.triangle_count);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_.get());
}

EmbreeRays& EmbreePeer::rays() {
  static EmbreeRays rays;
  return rays;
}

double EmbreePeer::trace(const RaySet& set, Call call, Workers& workers) {
  const bool coherent = set.coherent();
  EmbreeRays& rays = EmbreePeer::rays();
  return clock_.seconds_of([&] {
    switch (call) {
      case Call::kSingle:
        return set.any_hit() ? trace_single(rays.rays, coherent, workers)
                             : trace_single(rays.rayhits, coherent, workers);
      case Call::kPacket:
        return set.any_hit() ? trace_packet(rays.rays8, rays.last_valid, coherent, workers)
                             : trace_packet(rays.rayhits8, rays.last_valid, coherent, workers);
      case Call::kArray:
        return set.any_hit() ? trace_array(rays.rays, coherent, workers)
                             : trace_array(rays.rayhits, coherent, workers);
    }
  });
}

template <typename Ray>
void EmbreePeer::trace_single(std::vector<Ray>& rays, bool coherent, Workers& workers) const {
  workers.for_chunks(rays.size(), [&](size_t begin, size_t end) {
    const FlushDenormals flush;
    EmbreeQuery query(scene_.get(), coherent);
    for (size_t i = begin; i < end; ++i) query.trace(&rays[i]);
  });
}

template <typename Packet>
void EmbreePeer::trace_packet(std::vector<Packet>& packets, const int* last_valid, bool coherent,
                              Workers& workers) const {
  alignas(32) static constexpr int kAllValid[8] = {-1, -1, -1, -1, -1, -1, -1, -1};
  workers.for_chunks(packets.size(), [&](size_t begin, size_t end) {
    const FlushDenormals flush;
    EmbreeQuery query(scene_.get(), coherent);
    for (size_t i = begin; i < end; ++i) {
      query.trace(i + 1 == packets.size() ? last_valid : kAllValid, &packets[i]);
    }
  });
}

template <typename Ray>
void EmbreePeer::trace_array([[maybe_unused]] std::vector<Ray>& rays,
                             [[maybe_unused]] bool coherent,
                             [[maybe_unused]] Workers& workers) const {
  if constexpr (kEmbreeHasArrayCall) {
    workers.for_chunks(rays.size(), [&](size_t begin, size_t end) {
      const FlushDenormals flush;
      EmbreeQuery query(scene_.get(), coherent);
      query.trace_array(&rays[begin], static_cast<unsigned>(end - begin));
    });
  }
}

}  // namespace sobb::bench

extern "C" __attribute__((visibility("default"))) const sobb::bench::PeerLibrary*
sobb_bench_peer_library() {
  using namespace sobb::bench;
  static constexpr PeerLibrary kLibrary = {
      RTC_VERSION_STRING, kEmbreeHasArrayCall,
      [](const SceneInput& scene, Method method, const Flags& flags, uint32_t threads) -> Peer* {
        return new EmbreePeer(scene, method, flags, threads);
      }};
  return &kLibrary;
}
