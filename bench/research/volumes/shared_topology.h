// SPDX-License-Identifier: Apache-2.0
// SharedTopology is what every method of a comparison has in common: the triangles, which of them
// lie together in leaves, and which leaves in nodes.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "base/memory.h"
#include "base/scheduler.h"
#include "builder/mesh.h"
#include "builder/topology/topology.h"
#include "builder/wide/collapse.h"
#include "format/image.h"
#include "format/layout.h"
#include "sobb/sobb.h"

namespace sobb::study {

// Built once per scene, at medium quality. Immutable; any number of threads may read it.
class SharedTopology {
 public:
  // Borrows the triangles. Fails as sobb_build() does.
  SharedTopology(const sobb_triangles& triangles, const Scheduler& scheduler,
                 std::shared_ptr<Memory> memory);

  // The nodes of one width, and their triangle blocks.
  struct Layout {
    WideTopology wide;
    Image block_bytes;
    double ms = 0;  // wall clock time of collapse and blocks

    explicit Layout(WideTopology&& wide) : wide(std::move(wide)) {}
    std::span<const TriangleBlock> blocks() const {
      return {reinterpret_cast<const TriangleBlock*>(block_bytes.bytes().data()), wide.block_count};
    }
  };
  const Layout& layout(uint32_t width) const;  // 2 or 8

  double topology_ms() const { return topology_ms_; }  // for boxes and binary nodes
  double layout_ms(uint32_t width) const { return layout(width).ms; }
  uint32_t depth(uint32_t width) const { return layout(width).wide.depth; }
  uint64_t node_count(uint32_t width) const { return layout(width).wide.node_count; }
  uint64_t leaf_count() const { return leaf_count_; }
  uint64_t reference_count() const { return topology_->root().count; }

  const Mesh& mesh() const { return mesh_; }
  const MeshSummary& summary() const { return summary_; }
  const std::shared_ptr<Memory>& memory() const { return memory_; }

 private:
  std::shared_ptr<Memory> memory_;
  Mesh mesh_;
  MeshSummary summary_;
  std::unique_ptr<Topology> topology_;
  double topology_ms_ = 0;
  uint64_t leaf_count_ = 0;
  std::unique_ptr<Layout> binary_;
  std::unique_ptr<Layout> eight_wide_;
};

}  // namespace sobb::study
