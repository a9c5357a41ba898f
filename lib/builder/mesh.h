// SPDX-License-Identifier: Apache-2.0
// The caller's triangles, checked once, and what the file says of them.
#pragma once

#include <cstdint>
#include <cstring>
#include <memory_resource>

#include "base/scheduler.h"
#include "sobb/sobb.h"

namespace sobb {

struct Point {
  float x, y, z;
};

// Borrowed triangles in which every index is in range and every coordinate that a triangle uses is
// finite and within 2^60.
class Mesh {
 public:
  // Throws INVALID_ARGUMENT, EMPTY, INDEX, NOT_FINITE or TOO_LARGE, naming the first culprit.
  Mesh(const sobb_triangles& triangles, const Scheduler& scheduler);

  uint64_t triangle_count() const { return triangle_count_; }

  Point vertex(uint64_t index) const {
    Point point;
    std::memcpy(&point, vertices_ + index * stride_, sizeof point);
    return point;
  }
  // Corner 0, 1 or 2 of a triangle.
  Point corner(uint64_t triangle, int i) const { return vertex(indices_[3 * triangle + i]); }
  uint32_t index(uint64_t triangle, int i) const { return indices_[3 * triangle + i]; }

  // Read a triangle's indices, or its corners by them, so that they are in the cache when they are
  // needed. A prefetch would not do: it is dropped where the page is not in the TLB.
  void touch_indices(uint64_t triangle) const { touch(indices_ + 3 * triangle); }
  void touch_corners(uint64_t triangle) const {
    for (int i = 0; i < 3; ++i) touch(vertices_ + index(triangle, i) * stride_);
  }

 private:
  static void touch(const void* at) {
    static_cast<void>(*static_cast<const volatile unsigned char*>(at));
  }

  const unsigned char* vertices_;
  uint64_t vertex_count_;
  uint64_t stride_;
  const uint32_t* indices_;
  uint64_t triangle_count_;
};

// The mesh as the file's header and build record describe it.
struct MeshSummary {
  Point lower;  // the box of the vertices that triangles use
  Point upper;
  Point centre;
  float radius;  // no used vertex is further from the centre
  uint64_t degenerate_count;
  // XXH3-64 over the XXH3-64 of each 65,536 triangles, a triangle being its nine coordinates and
  // then its three indices.
  uint64_t source_hash;
};

// Summarises in parallel; the result is the same for any number of threads.
MeshSummary summarise(const Mesh& mesh, const Scheduler& scheduler,
                      std::pmr::memory_resource& scratch);

}  // namespace sobb
