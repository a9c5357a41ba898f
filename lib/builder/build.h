// SPDX-License-Identifier: Apache-2.0
// The whole way from triangles to a file image, stage by stage.
//
// `lib/builder` builds hierarchies. Each of its rooms knows those before it and none after it:
//   builder         mesh (the caller's triangles), scene_directions (a table fitted to them), array
//   boxes           frame, boxes, triangles cut to boxes, binary nodes
//   sah             splits a node by the surface area heuristic
//   topology        the binary hierarchy
//   wide            the wide hierarchy, and the walk from its leaves to its root
//   volumes         k-DOPs, bases, and the bytes of nodes and blocks
//   build           calls them all
// All of them may use `lib/base`, `lib/bounds` and `lib/format`.
#pragma once

#include <memory>

#include "base/memory.h"
#include "base/progress.h"
#include "base/scheduler.h"
#include "format/image.h"
#include "format/view.h"
#include "sobb/sobb.h"

namespace sobb {

// sobb_build_options with the defaults filled in and the values checked.
struct BuildSettings {
  sobb_volume volume;
  sobb_quality quality;
  sobb_strategy strategy;
  sobb_table table;
  sobb_isa isa;
  uint32_t k;      // 6 for the AABB
  uint32_t width;  // 4 or 8

  // Errors: INVALID_ARGUMENT, UNSUPPORTED_CPU.
  explicit BuildSettings(const sobb_build_options& options);
};

// Wall-clock time by stage.
struct BuildTimes {
  double topology_ms = 0;
  double collapse_ms = 0;
  double volume_ms = 0;
  double total_ms = 0;
};

// A hierarchy: its bytes, and their view.
struct Built {
  Image image;
  FileView view;
  BuildTimes times;
};

// Errors as sobb_build() states.
Built build(const sobb_triangles& triangles, const BuildSettings& settings,
            const Scheduler& scheduler, const std::shared_ptr<Memory>& memory, Progress& progress);

}  // namespace sobb
