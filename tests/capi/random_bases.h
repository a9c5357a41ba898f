// SPDX-License-Identifier: Apache-2.0
// Hierarchies whose nodes are of every kind, however seldom builds choose it.
#pragma once

#include <cstdint>

#include "capi/handles.h"

namespace sobb::test {

// An SOBB hierarchy's tree and triangles, each node bounded anew at random: by the frame, by three
// directions that its children share, or by three of each child's own.
HierarchyHandle with_random_bases(const HierarchyHandle& hierarchy, uint64_t seed);

}  // namespace sobb::test
