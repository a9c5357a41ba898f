// SPDX-License-Identifier: Apache-2.0
// A ray set in the layouts that Embree's callers hold natively, filled outside of the timed part.
#pragma once

#include <vector>

#include "embree_calls.h"
#include "trace_output.h"

namespace sobb::bench {

/// Embree writes hits into its rays, so the rays are loaded anew before each pass. The buffers are
/// kept from pass to pass: their pages are touched once.
class EmbreeRays {
 public:
  void load(const RaySet& set, Call call);
  /// What the last pass found.
  void read(const RaySet& set, Call call, TraceOutput& output) const;

  std::vector<RTCRayHit> rayhits;
  std::vector<RTCRayHit8> rayhits8;
  std::vector<RTCRay> rays;
  std::vector<RTCRay8> rays8;
  /// Which lanes of the last packet hold rays (all of those before it do).
  alignas(32) int last_valid[8] = {};
};

}  // namespace sobb::bench
