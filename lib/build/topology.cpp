// SPDX-License-Identifier: Apache-2.0
#include "build/topology.h"

#include "base/isa.h"
#include "build/embree_topology.h"
#include "build/topology_builder.h"

namespace sobb {
namespace {

constexpr uint64_t kGrain = 1 << 14;
// Room for the references that spatial splits add, as a part of the triangles.
constexpr double kSplitRoom = 0.25;

BinaryNodes own_topology(const Mesh& mesh, bool splits, const Scheduler& scheduler, Memory& memory,
                         Progress& progress, double progress_end, const Frame& frame,
                         sobb_isa isa) {
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
  builder.build(progress, progress_end);
  references = {};
  other = {};
  nodes.pairs = builder.collect(nodes.root);
  return nodes;
}

}  // namespace

Topology::Topology(const Mesh& mesh, sobb_quality quality, const Scheduler& scheduler,
                   Memory& memory, Progress& progress, double progress_end, const Frame& frame,
                   sobb_isa isa)
    : nodes_(quality == SOBB_QUALITY_LOW
                 ? embree_topology(mesh, scheduler, memory, progress, progress_end, frame)
                 : own_topology(mesh, quality == SOBB_QUALITY_HIGH, scheduler, memory, progress,
                                progress_end, frame, isa)) {}

}  // namespace sobb
