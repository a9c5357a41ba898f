// SPDX-License-Identifier: Apache-2.0
// A hierarchy of any bounding volume, over a topology that all of them share: the comparison on the
// same terms. For studies and tests; what ships is format/ and trace/.
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
  uint32_t width = 2;  // children a node: 2 or 8
  sobb_strategy strategy = SOBB_STRATEGY_K2;
  sobb_isa isa = SOBB_ISA_BEST;  // of conversion and tracing; never changes a result
};

struct Areas {
  double inner = 0;  // of nodes' children that are nodes
  double leaf = 0;   // of those that are leaves
};

class Hierarchy {
 public:
  // Converts the topology: bounds of every leaf's triangles, merged upwards; a volume for every
  // child; the nodes. The topology is borrowed and must outlive the hierarchy.
  // Errors: INVALID_ARGUMENT, UNSUPPORTED_CPU, OUT_OF_MEMORY.
  Hierarchy(const SharedTopology& topology, const ConvertSettings& settings,
            const Scheduler& scheduler);
  ~Hierarchy();
  Hierarchy(Hierarchy&&) noexcept;
  Hierarchy& operator=(Hierarchy&&) noexcept;

  // Wall clock of the conversion, the paper's overhead.
  double convert_ms() const { return convert_ms_; }
  // Sums of the children's areas over that of the scene's box; 0 where that has none. O(nodes),
  // some microseconds each for 14-DOPs.
  Areas areas(const Scheduler& scheduler) const;
  uint64_t node_bytes() const;
  // How often a vertex is outside of a volume above it: 0, or there is a defect. O(n log n).
  uint64_t count_leaks() const;

  // Closest hits, the bits of sobb_intersect(). `counts`, one a ray, may be null. Returns how many
  // rays were not valid. Thread-safe.
  uint64_t intersect(const sobb_ray* rays, uint64_t count, sobb_hit* hits, sobb_count* counts,
                     const Scheduler& scheduler) const;

  struct Nodes;  // of one volume and width, for one instruction set

 private:
  const SharedTopology* topology_;
  std::unique_ptr<Nodes> nodes_;
  double convert_ms_ = 0;
};

}  // namespace sobb::study
