// SPDX-License-Identifier: Apache-2.0
// The binary hierarchy over the triangles' boxes along the axes of a frame, made by Embree's
// builder. It says which triangles lie together; volumes come later.
#pragma once

#include <cstdint>
#include <memory>

#include "base/memory.h"
#include "base/scheduler.h"
#include "build/box.h"
#include "build/progress.h"
#include "sobb/sobb.h"

namespace sobb {

inline constexpr uint32_t kMaxLeafReferences = 8;

// A triangle in a leaf, or the part of one that a spatial split left within `box`.
struct Reference {
  Box box;
  uint32_t primitive;
};

struct TopologyNode {
  uint64_t reference_count;  // below it
  bool is_leaf;
};

struct InnerNode : TopologyNode {
  const TopologyNode* child[2];
  Box box[2];  // the children's
};

struct LeafNode : TopologyNode {
  const Reference* references;  // by rising primitive, then box
};

// Owns the nodes, in Embree's memory.
class Topology {
 public:
  // Progress runs from 0 to `progress_end`. Errors: OUT_OF_MEMORY, MEMORY_LIMIT, CANCELLED,
  // INTERNAL. The same for any number of threads.
  Topology(const Mesh& mesh, sobb_quality quality, const Scheduler& scheduler, Memory& memory,
           Progress& progress, double progress_end, const Frame& frame = Frame());
  ~Topology();
  Topology(const Topology&) = delete;
  Topology& operator=(const Topology&) = delete;

  const TopologyNode* root() const { return root_; }

 private:
  struct Builder;  // keeps Embree out of this header

  std::unique_ptr<Builder> builder_;
  const TopologyNode* root_ = nullptr;
};

}  // namespace sobb
