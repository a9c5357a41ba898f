// SPDX-License-Identifier: Apache-2.0
#include "builder/topology/topology.h"

#include <utility>

#include "base/isa.h"
#include "builder/sah/sah_costs.h"
#include "builder/topology/embree_topology.h"
#include "builder/topology/reinsertion.h"
#include "builder/topology/topology_builder.h"

namespace sobb {
namespace {

constexpr uint64_t kGrain = 1 << 14;
// Room for the references that spatial splits add, as a part of the triangles.
constexpr double kSplitRoom = 0.25;

// More of either lowers the areas further, but rays gain no more than the build loses.
constexpr ReinsertionEffort kMediumEffort = {3, 0.05};
constexpr ReinsertionEffort kHighEffort = {3, 0.2};
// Spatial splits are kept where they cost so much less. (Reinsertion gains a little more without.)
constexpr double kSplitsAdvantage = 0.98;

// Of the progress.
struct Part {
  double begin;
  double end;
};

BinaryNodes own_topology(const Mesh& mesh, bool splits, const Scheduler& scheduler, Memory& memory,
                         Progress& progress, Part part, const Frame& frame, sobb_isa isa) {
  const uint64_t count = mesh.triangle_count();
  const uint64_t room = splits ? static_cast<uint64_t>(static_cast<double>(count) * kSplitRoom) : 0;
  Array<SahReference> references(count + room, memory);
  Array<SahReference> other(count + room, memory);
  scheduler.for_ranges(count, kGrain, [&](uint64_t begin, uint64_t end) {
    for (uint64_t i = begin; i < end; ++i) {
      references[i] = SahReference::of(box_of(mesh, i, frame), static_cast<uint32_t>(i));
    }
  });
  BinaryNodes nodes;
  nodes.primitives = Array<uint32_t>(count + room, memory);
  if (splits) nodes.boxes = Array<Box>(count + room, memory);
  const SahBuild build = {{references.data(), other.data()},
                          count,
                          room,
                          nodes.primitives.data(),
                          nodes.boxes.data(),
                          mesh,
                          frame};
  TopologyBuilder builder(build, sah_kernels(resolve_isa(isa)), scheduler, memory);
  builder.build(progress, part.begin, part.end);
  references = {};
  other = {};
  nodes.pairs = builder.collect(nodes.root);
  return nodes;
}

// By the surface area heuristic, over half the root's area.
double cost_of(const BinaryNodes& nodes) {
  double cost = 0;
  for (const NodePair& pair : std::span<const NodePair>(nodes.pairs)) {
    for (const TopologyNode& node : pair.child) {
      const double own = node.is_leaf ? kLeafBlockCost * static_cast<double>(blocks_of(node.count))
                                      : kBinaryStepCost;
      cost += own * node.box.half_area();
    }
  }
  return cost;
}

// High quality is the better of two. Spatial splits gain much in some scenes; in others, such as
// cities, what they add in references costs more than they save, which only shows in the end.
BinaryNodes topology_of(sobb_quality quality, const Mesh& mesh, const Scheduler& scheduler,
                        Memory& memory, Progress& progress, double progress_end, const Frame& frame,
                        sobb_isa isa) {
  if (quality == SOBB_QUALITY_LOW) {
    return embree_topology(mesh, scheduler, memory, progress, progress_end, frame);
  }
  const bool high = quality == SOBB_QUALITY_HIGH;
  const ReinsertionEffort& effort = high ? kHighEffort : kMediumEffort;
  const double whole_end = progress_end * (high ? 0.2 : 0.95);
  const double split_end = progress_end * (high ? 0.8 : 0.95);
  BinaryNodes nodes =
      own_topology(mesh, false, scheduler, memory, progress, {0, whole_end}, frame, isa);
  if (high) {
    BinaryNodes split =
        own_topology(mesh, true, scheduler, memory, progress, {whole_end, split_end}, frame, isa);
    if (cost_of(split) < kSplitsAdvantage * cost_of(nodes)) nodes = std::move(split);
  }
  ProgressStage stage(progress, split_end, progress_end, effort.rounds);
  reinsert(nodes, effort, scheduler, memory, stage);
  return nodes;
}

}  // namespace

Topology::Topology(const Mesh& mesh, sobb_quality quality, const Scheduler& scheduler,
                   Memory& memory, Progress& progress, double progress_end, const Frame& frame,
                   sobb_isa isa)
    : nodes_(topology_of(quality, mesh, scheduler, memory, progress, progress_end, frame, isa)) {}

}  // namespace sobb
