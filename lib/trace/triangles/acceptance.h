// SPDX-License-Identifier: Apache-2.0
// The one seam at which a candidate becomes a ray's hit: every kernel and the oracle ask here.
//
// A candidate is taken if it lies in the ray's closed interval, precedes the best hit so far, and
// every further condition of the query allows it. Where the packet kernel decides for several rays
// at once, acceptance_lanes-inl.h compares in lanes and asks the conditions here.
#pragma once

#include <hwy/base.h>

#include <cstdint>

#include "sobb/sobb.h"

namespace sobb {

// A hierarchy has one geometry and no instances, so that these ids are the same in every hit.
inline constexpr uint32_t kOnlyGeometry = 0;
inline constexpr uint32_t kNoInstance = SOBB_MISS;

struct Candidate {
  float t;
  uint32_t primitive;
};

// The order of hits: by t, at equal t by (instance, geometry, primitive). Only primitives differ.
HWY_INLINE bool precedes(const Candidate& a, const Candidate& b) {
  return a.t == b.t ? a.primitive < b.primitive : a.t < b.t;
}

// Conditions that a query adds, such as a mask or an excluded primitive. Each is a class with
//   static bool allows(const Candidate& candidate);
template <class... Condition>
struct Conditions {
  static constexpr bool kNone = sizeof...(Condition) == 0;

  static bool allow([[maybe_unused]] const Candidate& candidate) {
    return (Condition::allows(candidate) && ...);
  }
};

// Those of every query today.
using QueryConditions = Conditions<>;

// `best` is the best hit so far, at first the interval's end.
template <class List = QueryConditions>
HWY_INLINE bool accepts(const Candidate& candidate, float tmin, const Candidate& best) {
  return candidate.t >= tmin && precedes(candidate, best) && List::allow(candidate);
}

}  // namespace sobb
