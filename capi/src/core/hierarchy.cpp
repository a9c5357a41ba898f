// SPDX-License-Identifier: Apache-2.0
// The handle: build, references, information.
#include "hierarchy.h"

#include <memory_resource>
#include <utility>

#include "../guard.h"
#include "base/isa.h"
#include "format/statistics.h"

using sobb::guard;
using sobb::Memory;
using sobb::require;

sobb_hierarchy::sobb_hierarchy(std::shared_ptr<Memory> of, sobb::Image bytes,
                               const sobb::FileView& parts)
    : memory(std::move(of)),
      image(std::move(bytes)),
      view(parts),
      tracer(parts),
      kernels(&sobb::trace_kernels(sobb::resolve_isa(SOBB_ISA_BEST))) {}

namespace sobb {

// NOLINTNEXTLINE(performance-unnecessary-value-param): it is moved on
sobb_hierarchy* make_hierarchy(std::shared_ptr<Memory> memory, Image image, const FileView& view) {
  std::pmr::polymorphic_allocator<> allocator(memory.get());
  auto* hierarchy = allocator.new_object<sobb_hierarchy>(std::move(memory), std::move(image), view);
  hierarchy->memory->lift_limit();
  return hierarchy;
}

}  // namespace sobb

extern "C" {

sobb_status sobb_build(const sobb_triangles* triangles, const sobb_build_options* options,
                       sobb_hierarchy** out) {
  return guard([&] {
    require(triangles, "triangles");
    require(out, "out");
    const sobb_triangles input = sobb::read_options(triangles, "triangles");
    const sobb_build_options known = sobb::read_options(options, "build options");
    const sobb::BuildSettings settings(known);
    const sobb::Scheduler scheduler(known.threads, known.scheduler);
    auto memory = std::make_shared<Memory>(known.allocator, known.memory_limit);
    sobb::Progress progress(known.progress, known.progress_user);
    sobb::Built built = sobb::build(input, settings, scheduler, memory, progress);
    sobb_hierarchy* hierarchy =
        sobb::make_hierarchy(std::move(memory), std::move(built.image), built.view);
    hierarchy->times = built.times;
    hierarchy->peak_bytes = hierarchy->memory->peak();
    *out = hierarchy;
  });
}

sobb_hierarchy* sobb_retain(sobb_hierarchy* hierarchy) {
  if (hierarchy != nullptr) hierarchy->references.fetch_add(1, std::memory_order_relaxed);
  return hierarchy;
}

void sobb_release(sobb_hierarchy* hierarchy) {
  if (hierarchy == nullptr) return;
  if (hierarchy->references.fetch_sub(1, std::memory_order_acq_rel) != 1) return;
  const std::shared_ptr<Memory> memory = hierarchy->memory;  // outlives the handle in it
  std::pmr::polymorphic_allocator<>(memory.get()).delete_object(hierarchy);
}

sobb_status sobb_get_info(const sobb_hierarchy* hierarchy, sobb_info* info) {
  return guard([&] {
    require(hierarchy, "hierarchy");
    const sobb::FileView& view = hierarchy->view;
    const sobb::Statistics statistics = sobb::measure(view);
    sobb_info known{};
    known.format_version = view.header->version;
    known.volume = view.header->volume;
    known.k = 2 * view.header->direction_count;
    known.quality = view.record->quality;
    known.strategy = view.record->strategy;
    known.width = view.header->width;
    known.depth = view.header->depth;
    known.triangles = view.header->triangle_count;
    known.degenerate = view.record->degenerate_count;
    known.references = view.record->reference_count;
    known.nodes = view.node_count;
    known.leaves = statistics.leaves;
    known.blocks = view.blocks.size();
    known.axes_nodes = statistics.axes_nodes;
    known.shared_nodes = statistics.shared_nodes;
    known.own_nodes = statistics.own_nodes;
    known.bytes = std::as_const(hierarchy->image).bytes().size();
    known.node_bytes = view.node_count * 32 * view.header->width;
    known.triangle_bytes = view.blocks.size_bytes();
    known.source_hash = view.record->source_hash;
    for (int k = 0; k < 3; ++k) {
      known.bounds_min[k] = view.record->bounds_min[k];
      known.bounds_max[k] = view.record->bounds_max[k];
    }
    known.inner_area = statistics.inner_area;
    known.leaf_area = statistics.leaf_area;
    known.topology_ms = hierarchy->times.topology_ms;
    known.collapse_ms = hierarchy->times.collapse_ms;
    known.volume_ms = hierarchy->times.volume_ms;
    known.total_ms = hierarchy->times.total_ms;
    known.peak_bytes = hierarchy->peak_bytes;
    known.table = view.table;
    sobb::write_info(known, info, "info");
  });
}

}  // extern "C"
