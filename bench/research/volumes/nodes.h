// SPDX-License-Identifier: Apache-2.0
// Nodes is the interface to the nodes of a hierarchy, whatever their volume, width and instruction
// set.
#pragma once

#include <cstdint>
#include <memory>

#include "base/scheduler.h"
#include "volumes/hierarchy.h"
#include "volumes/shared_topology.h"
#include "volumes/tables.h"

namespace sobb::study {

struct Hierarchy::Nodes {
  Nodes() = default;
  Nodes(const Nodes&) = delete;
  Nodes& operator=(const Nodes&) = delete;
  virtual ~Nodes() = default;

  virtual void convert(const Scheduler& scheduler) = 0;
  virtual uint64_t bytes() const = 0;
  // Absolute sums, in the order of the nodes.
  virtual Areas areas(const Scheduler& scheduler) const = 0;
  virtual uint64_t count_leaks() const = 0;
  virtual uint64_t intersect(const sobb_ray* rays, uint64_t count, sobb_hit* hits,
                             sobb_count* counts) const = 0;

  // Makes nodes that are not converted yet. `isa` is resolved.
  static std::unique_ptr<Nodes> make(const SharedTopology& topology,
                                     const ConvertSettings& settings, sobb_isa isa);
};

}  // namespace sobb::study
