// SPDX-License-Identifier: Apache-2.0
// Bottom-up: the k-DOP of every child, its volume, and from these the nodes and triangle blocks of
// the file.
#pragma once

#include "base/memory.h"
#include "base/progress.h"
#include "base/scheduler.h"
#include "bounds/directions/direction_table.h"
#include "builder/mesh.h"
#include "builder/wide/collapse.h"
#include "format/writer/writer.h"
#include "sobb/sobb.h"

namespace sobb {

struct VolumeSettings {
  sobb_volume volume;
  sobb_strategy strategy;
  sobb_isa isa;
};

// Fills the nodes and blocks of `parts`, zeroed or not, whose header (centre, radius, width) and
// directions are set. Progress runs from `progress_begin` to 1.
void make_volumes(const Mesh& mesh, const WideTopology& wide, const VolumeSettings& settings,
                  const ImageParts& parts, const Scheduler& scheduler, Memory& memory,
                  Progress& progress, double progress_begin);

}  // namespace sobb
