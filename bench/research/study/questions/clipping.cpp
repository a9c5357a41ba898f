// SPDX-License-Identifier: Apache-2.0
// Would clipping a child with its parent's interval pay? A skewed child may stick out of its
// parent: how many visits does it save to know where the ray leaves the parent, and what time do
// they take?
#include <algorithm>
#include <limits>
#include <memory>

#include "check.h"
#include "stopwatch.h"
#include "study/bases/fitted_tree.h"
#include "study/study_scene.h"

namespace sobb::study {
namespace {

constexpr uint32_t kPlanes = 64;
constexpr uint32_t kWidths[] = {2, 4, 8};
constexpr int kTimedPasses = 5;

constexpr BasisRule kRules[] = {{BasisFrom::kEachChild, SOBB_STRATEGY_K2, false},
                                {BasisFrom::kSumOrAxes, SOBB_STRATEGY_K2, true}};

Json measure_width(StudyScene& scene, const Topology& topology, uint32_t width,
                   WorkCounter& counter) {
  const FittedTree tree(scene, topology, width, default_directions(kPlanes));
  Json rules = Json::array();
  for (const BasisRule& rule : kRules) {
    const auto bases = tree.choose(rule);
    const BoundedTree bounded = tree.bounded(bases);
    rules.push_back({{"rule", rule.name()},
                     {"unclipped", to_json(counter.count(bounded, Clip::kRay))},
                     {"clipped", to_json(counter.count(bounded, Clip::kParent))}});
  }
  return {{"width", width}, {"rules", rules}};
}

// Nanoseconds that the library's kernel takes on one thread, on average per node or block of a
// leaf.
Json time_library(StudyScene& scene, uint32_t width, const std::vector<sobb_ray>& rays) {
  sobb_build_options options = SOBB_BUILD_OPTIONS_INIT;
  options.width = width;
  sobb_hierarchy* built = nullptr;
  bench::check(sobb_build(&scene.triangles(), &options, &built));
  const std::shared_ptr<sobb_hierarchy> hierarchy(built, sobb_release);
  std::vector<sobb_hit> hits(rays.size());
  std::vector<sobb_count> counts(rays.size());
  sobb_trace_options trace = SOBB_TRACE_OPTIONS_INIT;
  trace.counts = counts.data();
  bench::check(sobb_intersect(built, rays.data(), rays.size(), hits.data(), &trace));
  double steps = 0;
  for (const sobb_count& count : counts) steps += count.nodes + count.blocks;

  trace.counts = nullptr;
  trace.threads = 1;
  const bench::Stopwatch stopwatch(trace.threads);
  double least = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < kTimedPasses; ++pass) {
    least = std::min(least, 1e9 * stopwatch.seconds_of([&] {
      bench::check(sobb_intersect(built, rays.data(), rays.size(), hits.data(), &trace));
    }));
  }
  const auto count = static_cast<double>(rays.size());
  return {{"width", width},
          {"ns_ray", rounded(least / count)},
          {"nodes_and_blocks", rounded(steps / count)},
          {"ns_step", rounded(least / steps)}};
}

}  // namespace

int clipping(const StudyOptions& options) {
  write_report(options, "clipping", for_each_scene(options, [&](StudyScene& scene) {
                 const Topology topology = scene.build_topology();
                 const auto rays = scene.secondary_rays(options.size);
                 WorkCounter counter(rays, scene.scheduler());
                 Json widths = Json::array();
                 for (const uint32_t width : kWidths) {
                   widths.push_back(measure_width(scene, topology, width, counter));
                 }
                 return Json{
                     {"rays", rays.size()},
                     {"widths", widths},
                     {"library", {time_library(scene, 4, rays), time_library(scene, 8, rays)}}};
               }));
  return 0;
}

}  // namespace sobb::study
