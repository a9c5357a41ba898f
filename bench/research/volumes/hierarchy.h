// SPDX-License-Identifier: Apache-2.0
// Hierarchy has nodes of any bounding volume, over a topology that all volumes share, so that they
// are compared on the same terms. The library ships none of it.
#pragma once

#include <cstdint>
#include <memory>

#include "base/memory.h"
#include "base/scheduler.h"
#include "sobb/sobb.h"
#include "volumes/method.h"
#include "volumes/shared_topology.h"

namespace sobb::study {

struct ConvertSettings {
  Method method;
  uint32_t width = 2;  // children per node: 2 or 8
  sobb_strategy strategy = SOBB_STRATEGY_K2;
  sobb_isa isa = SOBB_ISA_BEST;  // for conversion and tracing; never changes a result
};

struct Areas {
  double inner = 0;  // sum over children that are nodes
  double leaf = 0;   // sum over children that are leaves
};

class Hierarchy {
 public:
  // Converts the topology: bounds every leaf's triangles, merges the bounds upwards, fits a volume
  // to every child. The topology is borrowed and must outlive the hierarchy. Errors:
  // INVALID_ARGUMENT, UNSUPPORTED_CPU, OUT_OF_MEMORY.
  Hierarchy(const SharedTopology& topology, const ConvertSettings& settings,
            const Scheduler& scheduler);
  ~Hierarchy();
  Hierarchy(Hierarchy&&) noexcept;
  Hierarchy& operator=(Hierarchy&&) noexcept;

  // Wall clock time of the conversion, which the paper calls overhead.
  double convert_ms() const { return convert_ms_; }
  // Sums of the children's areas, divided by the area of the scene's box; 0 where that has none.
  // O(nodes); a 14-DOP takes some microseconds.
  Areas areas(const Scheduler& scheduler) const;
  uint64_t node_bytes() const;
  // Counts how often a vertex is outside of a volume above it. Anything but 0 is a defect. O(n log
  // n).
  uint64_t count_leaks() const;

  // Finds closest hits, with the bits of sobb_intersect(). `counts`, one per ray, may be null.
  // Returns how many rays were invalid. Thread-safe.
  uint64_t intersect(const sobb_ray* rays, uint64_t count, sobb_hit* hits, sobb_count* counts,
                     const Scheduler& scheduler) const;

  struct Nodes;  // one volume and width, for one instruction set

 private:
  const SharedTopology* topology_;
  std::unique_ptr<Nodes> nodes_;
  double convert_ms_ = 0;
};

}  // namespace sobb::study
