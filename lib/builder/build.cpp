// SPDX-License-Identifier: Apache-2.0
#include "builder/build.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/error.h"
#include "base/isa.h"
#include "bounds/directions/direction_table.h"
#include "builder/boxes/frame.h"
#include "builder/mesh.h"
#include "builder/scene_directions.h"
#include "builder/topology/topology.h"
#include "builder/volumes/volumes.h"
#include "builder/wide/collapse.h"
#include "format/writer/writer.h"

namespace sobb {
namespace {

// Where stages end on the scale of the progress, by measured time.
constexpr double kTopologyEnd = 0.7;
constexpr double kCollapseEnd = 0.75;

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Reads an option that is an enumerator, 0 standing for the default.
template <class Enum>
Enum choose(uint32_t value, Enum default_value, uint32_t last, const char* name) {
  if (value > last) fail(SOBB_ERROR_INVALID_ARGUMENT, "build options: %s is %u", name, value);
  return value == 0 ? default_value : static_cast<Enum>(value);
}

uint32_t choose_number(uint32_t value, uint32_t default_value,
                       std::initializer_list<uint32_t> allowed, const char* name) {
  if (value == 0) return default_value;
  if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) {
    fail(SOBB_ERROR_INVALID_ARGUMENT, "build options: %s is %u", name, value);
  }
  return value;
}

void fill_record(const MeshSummary& summary, uint64_t reference_count,
                 const BuildSettings& settings, BuildRecord& record) {
  record.quality = settings.quality;
  record.strategy = settings.strategy;
  record.degenerate_count = summary.degenerate_count;
  record.reference_count = reference_count;
  record.source_hash = summary.source_hash;
  record.bounds_min[0] = summary.lower.x;
  record.bounds_min[1] = summary.lower.y;
  record.bounds_min[2] = summary.lower.z;
  record.bounds_max[0] = summary.upper.x;
  record.bounds_max[1] = summary.upper.y;
  record.bounds_max[2] = summary.upper.z;
}

DirectionSet choose_directions(const Mesh& mesh, const BuildSettings& settings,
                               const Scheduler& scheduler, Memory& memory) {
  if (settings.table == SOBB_TABLE_FITTED) {
    return scene_directions(mesh, settings.k, scheduler, memory);
  }
  return default_direction_set(settings.k, memory);
}

}  // namespace

BuildSettings::BuildSettings(const sobb_build_options& options)
    : volume(choose(options.volume, SOBB_VOLUME_SOBB, SOBB_VOLUME_SOBB, "volume")),
      quality(choose(options.quality, SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH, "quality")),
      strategy(choose(options.strategy, SOBB_STRATEGY_K2, SOBB_STRATEGY_K3, "strategy")),
      table(choose(options.table,
                   volume == SOBB_VOLUME_AABB ? SOBB_TABLE_SPREAD : SOBB_TABLE_FITTED,
                   SOBB_TABLE_FITTED, "table")),
      isa(resolve_isa(options.isa)),
      k(choose_number(options.k, 64, {32, 48, 64}, "k")),
      width(choose_number(options.width, 8, {4, 8}, "width")) {
  if (options.reserved != 0) {
    fail(SOBB_ERROR_INVALID_ARGUMENT, "build options: reserved is %u", options.reserved);
  }
  if (volume != SOBB_VOLUME_AABB) return;
  if (table == SOBB_TABLE_FITTED) {
    fail(SOBB_ERROR_INVALID_ARGUMENT,
         "build options: a fitted table is for SOBBs, and the volume is the AABB");
  }
  k = 6;
}

Built build(const sobb_triangles& triangles, const BuildSettings& settings,
            const Scheduler& scheduler, const std::shared_ptr<Memory>& memory, Progress& progress) {
  BuildTimes times;
  const auto start = Clock::now();
  progress.check(0, kTopologyEnd, 0);
  const Mesh mesh(triangles, scheduler);
  const MeshSummary summary = summarise(mesh, scheduler, *memory);
  const DirectionSet table = choose_directions(mesh, settings, scheduler, *memory);
  const Frame frame(table, summary.centre);
  const Topology topology(mesh, settings.quality, scheduler, *memory, progress, kTopologyEnd, frame,
                          settings.isa);
  times.topology_ms = ms_since(start);

  const auto collapse_start = Clock::now();
  const WideTopology wide = collapse(topology, settings.width, scheduler, *memory);
  times.collapse_ms = ms_since(collapse_start);
  progress.check(kTopologyEnd, kCollapseEnd, 1);

  const auto volume_start = Clock::now();
  const VolumeScene scene = {mesh,
                             frame,
                             table.directions,
                             {summary.centre.x, summary.centre.y, summary.centre.z},
                             summary.radius};
  const Shape shape = {settings.width, static_cast<uint32_t>(table.directions.size()),
                       wide.node_count, wide.block_count};
  ImageParts parts;
  Image image = begin_image(memory, shape, parts, Zeroed::kAllButNodesAndBlocks);
  std::copy(table.directions.begin(), table.directions.end(), parts.directions.begin());
  fill_record(summary, wide.reference_count, settings, *parts.record);
  make_volumes(scene, wide, {settings.volume, settings.strategy, settings.isa},
               {settings.width, parts.nodes, parts.blocks}, scheduler, *memory, progress,
               kCollapseEnd);
  finish_image(image, shape,
               {settings.volume,
                wide.depth,
                {scene.centre[0], scene.centre[1], scene.centre[2]},
                scene.radius,
                mesh.triangle_count()},
               scheduler);
  times.volume_ms = ms_since(volume_start);
  times.total_ms = ms_since(start);
  FileView view = view_of(image.bytes());
  view.table = table.table;
  return {std::move(image), view, times};
}

}  // namespace sobb
