// SPDX-License-Identifier: Apache-2.0
#include "builder/topology/topology.h"

#include <utility>

#include "base/isa.h"
#include "builder/sah/sah_costs.h"
#include "builder/topology/morton_topology.h"
#include "builder/topology/reinsertion.h"
#include "builder/topology/topology_builder.h"

namespace sobb {
namespace {

constexpr uint64_t kGrain = 1 << 14;
// Room for the references that spatial splits add, per triangle.
constexpr double kSplitRoom = 0.25;

// More rounds or a larger share would lower the areas further, but rays would gain no more than the
// build would lose.
constexpr ReinsertionEffort kMediumEffort = {3, 0.05};
constexpr ReinsertionEffort kHighEffort = {3, 0.2};
// The hierarchy with spatial splits is kept if its cost is below this share of the other's.
// (Reinsertion gains a little more on the one without.)
constexpr double kSplitsAdvantage = 0.98;

// A stage's share of the progress.
struct ProgressShare {
  double begin;
  double end;
};

BinaryNodes own_topology(const Mesh& mesh, bool splits, const Scheduler& scheduler, Memory& memory,
                         Progress& progress, ProgressShare share, const Frame& frame,
                         sobb_isa isa) {
  const uint64_t count = mesh.triangle_count();
  const uint64_t room = splits ? static_cast<uint64_t>(static_cast<double>(count) * kSplitRoom) : 0;
  Array<SahReference> references(count + room, memory);
  Array<SahReference> other(count + room, memory);
  scheduler.for_ranges(count, kGrain, [&](uint64_t begin, uint64_t end) {
    for (uint64_t i = begin; i < end; ++i) {
      references[i] = SahReference::whole(box_of(mesh, i, frame), static_cast<uint32_t>(i));
    }
  });
  BinaryNodes nodes;
  nodes.primitives = Array<uint32_t>(count + room, memory);
  if (splits) nodes.cuts = Array<Box>(count + room, memory);
  const SahBuild build = {{references.data(), other.data()},
                          count,
                          room,
                          nodes.primitives.data(),
                          nodes.cuts.data(),
                          mesh,
                          frame};
  TopologyBuilder builder(build, sah_kernels(resolve_isa(isa)), scheduler, memory);
  builder.build(progress, share.begin, share.end);
  references = {};
  other = {};
  nodes.pairs = builder.collect(nodes.root);
  return nodes;
}

// The cost by the surface area heuristic, times half the root's area.
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

// High quality is the better of two hierarchies, one of them with spatial splits. Splits gain much
// in some scenes; in others, such as cities, the references that they add cost more than they save,
// which only shows in the end.
BinaryNodes topology_of(sobb_quality quality, const Mesh& mesh, const Scheduler& scheduler,
                        Memory& memory, Progress& progress, double progress_end, const Frame& frame,
                        sobb_isa isa) {
  if (quality == SOBB_QUALITY_LOW) {
    return morton_topology(mesh, sah_kernels(resolve_isa(isa)), scheduler, memory, progress,
                           progress_end, frame);
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
