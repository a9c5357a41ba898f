// SPDX-License-Identifier: Apache-2.0
#include "volumes/hierarchy.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/float_control.h"
#include "base/isa.h"
#include "volumes/box_area.h"
#include "volumes/nodes.h"

namespace sobb::study {
namespace {

constexpr uint64_t kChunk = 1024;  // rays per task

// Products of lengths, areas and their reciprocals stay far from the ends of a float within these.
void check_radius(float radius) {
  if (radius != 0 && !(radius >= 0x1p-40F && radius <= 0x1p40F)) {
    fail(SOBB_ERROR_INVALID_ARGUMENT, "a scene of radius %g: studies take 2^-40 to 2^40",
         static_cast<double>(radius));
  }
}

}  // namespace

Hierarchy::Hierarchy(const SharedTopology& topology, const ConvertSettings& settings,
                     const Scheduler& scheduler)
    : topology_(&topology) {
  topology.layout(settings.width);  // refuses other widths
  check_radius(topology.summary().radius);
  nodes_ = Nodes::make(topology, settings, resolve_isa(settings.isa));
  const auto start = std::chrono::steady_clock::now();
  nodes_->convert(scheduler);
  convert_ms_ =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

Hierarchy::~Hierarchy() = default;
Hierarchy::Hierarchy(Hierarchy&&) noexcept = default;
Hierarchy& Hierarchy::operator=(Hierarchy&&) noexcept = default;

Areas Hierarchy::areas(const Scheduler& scheduler) const {
  const double box = box_area(topology_->summary());
  const Areas sum = nodes_->areas(scheduler);
  return box > 0 ? Areas{sum.inner / box, sum.leaf / box} : Areas{};
}

uint64_t Hierarchy::node_bytes() const { return nodes_->bytes(); }

uint64_t Hierarchy::count_leaks() const { return nodes_->count_leaks(); }

uint64_t Hierarchy::intersect(const sobb_ray* rays, uint64_t count, sobb_hit* hits,
                              sobb_count* counts, const Scheduler& scheduler) const {
  std::atomic<uint64_t> invalid{0};
  scheduler.for_ranges(count, kChunk, [&](uint64_t begin, uint64_t end) {
    invalid += nodes_->intersect(rays + begin, end - begin, hits + begin,
                                 counts != nullptr ? counts + begin : nullptr);
  });
  return invalid;
}

}  // namespace sobb::study
