// SPDX-License-Identifier: Apache-2.0
#include "builder/build.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/isa.h"
#include "bounds/directions/direction_table.h"
#include "builder/mesh.h"
#include "builder/topology/frame.h"
#include "builder/topology/topology.h"
#include "builder/volumes/scene_directions.h"
#include "builder/volumes/volumes.h"
#include "builder/wide/collapse.h"
#include "format/writer/writer.h"

namespace sobb {
namespace {

// The parts of the progress that stages take, by measured time.
constexpr double kTopologyEnd = 0.7;
constexpr double kCollapseEnd = 0.75;

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// An enumerator of an option, 0 standing for the default.
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

void fill_header(const MeshSummary& summary, uint64_t triangle_count, const BuildSettings& settings,
                 uint32_t depth, FileHeader& header) {
  header.volume = settings.volume;
  header.depth = depth;
  header.centre[0] = summary.centre.x;
  header.centre[1] = summary.centre.y;
  header.centre[2] = summary.centre.z;
  header.radius = summary.radius;
  header.triangle_count = triangle_count;
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

std::pmr::vector<Direction> choose_directions(const Mesh& mesh, const BuildSettings& settings,
                                              const Scheduler& scheduler, Memory& memory) {
  if (settings.table == SOBB_TABLE_FITTED) {
    return scene_directions(mesh, settings.k, scheduler, memory);
  }
  const auto directions = default_directions(settings.k);
  return {directions.begin(), directions.end(), &memory};
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
  const auto directions = choose_directions(mesh, settings, scheduler, *memory);
  const Topology topology(mesh, settings.quality, scheduler, *memory, progress, kTopologyEnd,
                          Frame(directions, summary.centre), settings.isa);
  times.topology_ms = ms_since(start);

  const auto collapse_start = Clock::now();
  const WideTopology wide = collapse(topology, settings.width, scheduler, *memory);
  times.collapse_ms = ms_since(collapse_start);
  progress.check(kTopologyEnd, kCollapseEnd, 1);

  const auto volume_start = Clock::now();
  ImageParts parts;
  Image image = begin_image(
      memory,
      {settings.width, static_cast<uint32_t>(directions.size()), wide.node_count, wide.block_count},
      parts, Zeroed::kAllButNodesAndBlocks);
  fill_header(summary, mesh.triangle_count(), settings, wide.depth, *parts.header);
  fill_record(summary, wide.reference_count, settings, *parts.record);
  std::copy(directions.begin(), directions.end(), parts.directions.begin());
  make_volumes(mesh, wide, {settings.volume, settings.strategy, settings.isa}, parts, scheduler,
               *memory, progress, kCollapseEnd);
  seal_image(image, scheduler);
  times.volume_ms = ms_since(volume_start);
  times.total_ms = ms_since(start);
  const FileView view = {parts.header,    parts.directions, parts.nodes,
                         wide.node_count, parts.blocks,     parts.record};
  return {std::move(image), view, times};
}

}  // namespace sobb
