// SPDX-License-Identifier: Apache-2.0
#include "study/wide/wide_file.h"

#include <algorithm>

#include "base/error.h"
#include "base/isa.h"
#include "bounds/directions/direction_table.h"
#include "builder/volumes/volumes.h"
#include "format/writer/writer.h"

namespace sobb::study {
namespace {

void fill_record(const Mesh& mesh, const MeshSummary& summary, BuildRecord& record) {
  record.quality = SOBB_QUALITY_MEDIUM;
  record.strategy = SOBB_STRATEGY_K2;
  record.degenerate_count = summary.degenerate_count;
  record.reference_count = mesh.triangle_count();
  record.source_hash = summary.source_hash;
  record.bounds_min[0] = summary.lower.x;
  record.bounds_min[1] = summary.lower.y;
  record.bounds_min[2] = summary.lower.z;
  record.bounds_max[0] = summary.upper.x;
  record.bounds_max[1] = summary.upper.y;
  record.bounds_max[2] = summary.upper.z;
}

}  // namespace

std::shared_ptr<sobb_hierarchy> make_hierarchy(const Mesh& mesh, const MeshSummary& summary,
                                               const WideLayout& layout, uint32_t width) {
  const auto memory = std::make_shared<Memory>();
  const Scheduler scheduler(1, nullptr);
  Progress progress(nullptr, nullptr);
  const auto directions = default_directions(64);
  const Frame frame;
  const VolumeScene scene = {mesh,
                             frame,
                             directions,
                             {summary.centre.x, summary.centre.y, summary.centre.z},
                             summary.radius};
  const Shape shape = {width, static_cast<uint32_t>(directions.size()), layout.topology.node_count,
                       layout.topology.block_count};
  ImageParts parts;
  Image image = begin_image(memory, shape, parts);
  fill_record(mesh, summary, *parts.record);
  std::copy(directions.begin(), directions.end(), parts.directions.begin());
  make_volumes(scene, layout.topology,
               {SOBB_VOLUME_SOBB, SOBB_STRATEGY_K2, resolve_isa(SOBB_ISA_BEST)},
               {width, parts.nodes, parts.blocks}, scheduler, *memory, progress, 0);
  finish_image(image, shape,
               {SOBB_VOLUME_SOBB,
                layout.topology.depth,
                {scene.centre[0], scene.centre[1], scene.centre[2]},
                scene.radius,
                mesh.triangle_count()},
               scheduler);
  sobb_hierarchy* hierarchy = nullptr;
  const sobb_status status =
      sobb_open_memory(image.bytes().data(), image.bytes().size(), nullptr, &hierarchy);
  if (status != SOBB_OK) fail(status, "%s", sobb_last_error());
  return {hierarchy, sobb_release};
}

}  // namespace sobb::study
