// SPDX-License-Identifier: Apache-2.0
// The kinds of query.
#pragma once

namespace sobb {

// A ray looks for its closest hit, or for any (an occlusion query).
enum class Query { kClosest, kAny };

}  // namespace sobb
