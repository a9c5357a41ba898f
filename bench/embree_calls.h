// SPDX-License-Identifier: Apache-2.0
// Embree 3 or 4: its header, and one spelling for its tracing calls, which take their context
// differently.
#pragma once

#if SOBB_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace sobb::bench {

#if SOBB_EMBREE_MAJOR >= 4

class EmbreeQuery {
 public:
  EmbreeQuery(RTCScene scene, bool coherent) : scene_(scene) {
    const RTCRayQueryFlags flags =
        coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    rtcInitIntersectArguments(&intersect_);
    rtcInitOccludedArguments(&occluded_);
    intersect_.flags = occluded_.flags = flags;
  }

  void trace(RTCRayHit* ray) { rtcIntersect1(scene_, ray, &intersect_); }
  void trace(RTCRay* ray) { rtcOccluded1(scene_, ray, &occluded_); }
  void trace(const int* valid, RTCRayHit8* rays) {
    rtcIntersect8(valid, scene_, rays, &intersect_);
  }
  void trace(const int* valid, RTCRay8* rays) { rtcOccluded8(valid, scene_, rays, &occluded_); }
  template <typename Ray>
  void trace_array(Ray* rays, unsigned count) = delete;  // see kEmbreeHasArrayCall

 private:
  RTCScene scene_;
  RTCIntersectArguments intersect_;
  RTCOccludedArguments occluded_;
};

#else

class EmbreeQuery {
 public:
  EmbreeQuery(RTCScene scene, bool coherent) : scene_(scene) {
    rtcInitIntersectContext(&context_);
    context_.flags =
        coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }

  void trace(RTCRayHit* ray) { rtcIntersect1(scene_, &context_, ray); }
  void trace(RTCRay* ray) { rtcOccluded1(scene_, &context_, ray); }
  void trace(const int* valid, RTCRayHit8* rays) { rtcIntersect8(valid, scene_, &context_, rays); }
  void trace(const int* valid, RTCRay8* rays) { rtcOccluded8(valid, scene_, &context_, rays); }
  void trace_array(RTCRayHit* rays, unsigned count) {
    rtcIntersect1M(scene_, &context_, rays, count, sizeof *rays);
  }
  void trace_array(RTCRay* rays, unsigned count) {
    rtcOccluded1M(scene_, &context_, rays, count, sizeof *rays);
  }

 private:
  RTCScene scene_;
  RTCIntersectContext context_;
};

#endif

/// True where Embree has a call for a whole array: version 4 gave it up.
inline constexpr bool kEmbreeHasArrayCall = SOBB_EMBREE_MAJOR < 4;

}  // namespace sobb::bench
