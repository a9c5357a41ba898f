// SPDX-License-Identifier: Apache-2.0
// EmbreeRays holds a ray set in the layouts of Embree's callers. They are filled outside of the
// timed part.
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
  /// -1 in the last packet's lanes that hold rays, else 0. All lanes of the packets before it do.
  alignas(32) int last_valid[8] = {};
};

}  // namespace sobb::bench
