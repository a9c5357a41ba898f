// SPDX-License-Identifier: Apache-2.0
// From a wide topology to the nodes and triangle blocks of the file, bottom-up: a leaf's k-DOP,
// k-DOPs merged upward, the bases of each node by them, then its bytes.
//
// The room `builder/volumes` has one concept per file: leaf_kdop fits a leaf, node_bases chooses a
// node's bases by the surface area heuristic, node_bounder merges k-DOPs and has bases chosen,
// basis_savings tells whether bases are worth choosing at all, node_writer writes nodes and blocks.
// It knows `builder/wide`, `bounds` and the layout of the file; only `builder/build` calls it.
#pragma once

#include <cstdint>
#include <span>

#include "base/memory.h"
#include "base/progress.h"
#include "base/scheduler.h"
#include "builder/volumes/node_bounder.h"
#include "builder/wide/wide_topology.h"
#include "format/layout.h"
#include "sobb/sobb.h"

namespace sobb {

struct VolumeSettings {
  sobb_volume volume;
  sobb_strategy strategy;
  sobb_isa isa;
};

// Where nodes and blocks are written, all bytes of them.
struct NodeOutput {
  uint32_t width;
  void* nodes;  // Node<width>, as many as the topology has
  std::span<TriangleBlock> blocks;
};

// Writes all nodes and blocks. Progress runs from `progress_begin` to 1.
void make_volumes(const VolumeScene& scene, const WideTopology& wide,
                  const VolumeSettings& settings, const NodeOutput& output,
                  const Scheduler& scheduler, Memory& memory, Progress& progress,
                  double progress_begin);

}  // namespace sobb
