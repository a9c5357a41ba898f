// SPDX-License-Identifier: Apache-2.0
#include "build/topology.h"

#include "base/isa.h"
#include "build/embree_topology.h"
#include "build/topology_builder.h"

namespace sobb {
namespace {

constexpr uint64_t kGrain = 1 << 14;

BinaryNodes own_topology(const Mesh& mesh, const Scheduler& scheduler, Memory& memory,
                         Progress& progress, double progress_end, const Frame& frame,
                         sobb_isa isa) {
  const uint64_t count = mesh.triangle_count();
  Array<SahReference> references(count, memory);
  Array<SahReference> other(count, memory);
  scheduler.for_ranges(count, kGrain, [&](uint64_t begin, uint64_t end) {
    for (uint64_t i = begin; i < end; ++i) {
      references[i] = SahReference::of(box_of(mesh, i, frame), static_cast<uint32_t>(i));
    }
  });
  BinaryNodes nodes;
  nodes.primitives = Array<uint32_t>(count, memory);
  TopologyBuilder builder(references.data(), other.data(), count, nodes.primitives.data(),
                          sah_kernels(resolve_isa(isa)), scheduler, memory);
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
    : nodes_(
          quality == SOBB_QUALITY_MEDIUM
              ? own_topology(mesh, scheduler, memory, progress, progress_end, frame, isa)
              : embree_topology(mesh, quality, scheduler, memory, progress, progress_end, frame)) {}

}  // namespace sobb
