// SPDX-License-Identifier: Apache-2.0
// TrianglesBelow says where the triangles below a node lie.
#pragma once

#include <cstdint>
#include <span>

#include "format/layout.h"

namespace sobb::study {

struct BlockRange {
  uint64_t first;
  uint64_t end;
};

struct TrianglesBelow {
  const TriangleBlock* blocks;
  std::span<const BlockRange> ranges;
};

}  // namespace sobb::study
