// SPDX-License-Identifier: Apache-2.0
// Are hierarchies built for AABBs the right ones? Every variant becomes a file of the library, and
// traces the same rays.
#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "check.h"
#include "difference.h"
#include "stopwatch.h"
#include "study/questions/topology_variants.h"
#include "study/report.h"
#include "study/study_options.h"
#include "study/study_scene.h"
#include "study/wide/wide_file.h"

namespace sobb::study {
namespace {

using bench::check;

constexpr int kRounds = 9;

using Hits = std::vector<sobb_hit>;
using Rays = std::vector<sobb_ray>;

void trace(sobb_hierarchy* hierarchy, const Rays& rays, Hits& hits, sobb_count* counts) {
  hits.resize(rays.size());
  sobb_trace_options options = SOBB_TRACE_OPTIONS_INIT;
  options.threads = 1;
  options.counts = counts;
  check(sobb_intersect(hierarchy, rays.data(), rays.size(), hits.data(), &options));
}

// Rays, and the hits that the library's own hierarchy finds.
struct RayTask {
  Rays rays;
  Hits expected;

  RayTask(sobb_hierarchy* hierarchy, Rays made) : rays(std::move(made)) {
    trace(hierarchy, rays, expected, nullptr);
  }
};

// Counts what a ray visits, on average. The hits must be the expected ones, bit by bit.
Json count_work(sobb_hierarchy* hierarchy, const RayTask& task) {
  std::vector<sobb_count> counts(task.rays.size());
  Hits hits;
  trace(hierarchy, task.rays, hits, counts.data());
  const size_t other = bench::first_difference(hits, task.expected);
  if (other != bench::kEqual) fail(SOBB_ERROR_INTERNAL, "ray %zu hits otherwise", other);
  uint64_t nodes = 0;
  uint64_t volumes = 0;
  uint64_t blocks = 0;
  uint64_t triangles = 0;
  for (const sobb_count& count : counts) {
    nodes += count.nodes;
    volumes += count.volumes;
    blocks += count.blocks;
    triangles += count.triangles;
  }
  const auto per_ray = [&](uint64_t sum) {
    return rounded(static_cast<double>(sum) / static_cast<double>(counts.size()));
  };
  return {{"nodes", per_ray(nodes)},
          {"volumes", per_ray(volumes)},
          {"blocks", per_ray(blocks)},
          {"triangles", per_ray(triangles)}};
}

// A variant's hierarchy, and its row of the report.
struct Entry {
  std::shared_ptr<sobb_hierarchy> hierarchy;
  Json row;
  bool timed = false;
  double seconds = std::numeric_limits<double>::infinity();
};

Entry make_entry(StudyScene& scene, const Variant& variant) {
  const WideLayout layout = lay_out(variant.tree, variant.cut, scene.memory());
  const bool binary = variant.layout == Layout::kBinary;
  Entry entry;
  entry.hierarchy = make_hierarchy(scene.mesh(), scene.summary(), layout, binary ? 4 : 8);
  entry.timed = !binary;  // binary nodes lie in ones made for four children
  sobb_info info = SOBB_INFO_INIT;
  check(sobb_get_info(entry.hierarchy.get(), &info));
  entry.row = {{"layout", binary ? "binary" : "wide"},
               {"splits", variant.splits},
               {"leaves_by", variant.leaves},
               {"collapse", variant.collapse},
               {"area_inner", rounded(info.inner_area)},
               {"area_leaf", rounded(info.leaf_area)},
               {"depth", info.depth},
               {"mean_leaf_depth", rounded(layout.mean_leaf_depth)},
               {"nodes", info.nodes},
               {"leaves", info.leaves},
               {"blocks", info.blocks},
               {"topology_ms", rounded(variant.topology_ms)},
               {"collapse_ms", rounded(variant.collapse_ms)}};
  return entry;
}

// Times every hierarchy once per round. Its fastest round counts: what else the machine does only
// ever adds processor time.
void time_all(std::vector<Entry>& entries, const Rays& rays) {
  Hits hits(rays.size());
  for (int round = 0; round < kRounds; ++round) {
    for (Entry& entry : entries) {
      if (!entry.timed) continue;
      const double seconds = bench::Stopwatch(1).seconds_of(
          [&] { trace(entry.hierarchy.get(), rays, hits, nullptr); });
      entry.seconds = std::min(entry.seconds, seconds);
    }
  }
  for (Entry& entry : entries) {
    if (!entry.timed) continue;
    entry.row["secondary"]["Mrays/s"] =
        rounded(1e-6 * static_cast<double>(rays.size()) / entry.seconds);
  }
}

Json compare(StudyScene& scene, uint32_t size) {
  sobb_hierarchy* built = nullptr;
  check(sobb_build(&scene.triangles(), nullptr, &built));
  const std::shared_ptr<sobb_hierarchy> own(built, sobb_release);
  const RayTask primary(built, scene.primary_rays(size));
  const RayTask secondary(built, scene.secondary_rays(size));

  std::vector<Entry> entries;
  each_variant(scene.mesh(), scene.summary(), scene.memory(), [&](const Variant& variant) {
    Entry entry = make_entry(scene, variant);
    entry.row["primary"] = count_work(entry.hierarchy.get(), primary);
    entry.row["secondary"] = count_work(entry.hierarchy.get(), secondary);
    entries.push_back(std::move(entry));
  });
  time_all(entries, secondary.rays);

  Json rows = Json::array();
  for (Entry& entry : entries) rows.push_back(std::move(entry.row));
  return {{"primary_rays", primary.rays.size()},
          {"secondary_rays", secondary.rays.size()},
          {"hierarchies", std::move(rows)}};
}

}  // namespace

int topologies(const StudyOptions& options) {
  write_report(options, "topologies", for_each_scene(options, [&](StudyScene& scene) {
                 return compare(scene, options.size);
               }));
  return 0;
}

}  // namespace sobb::study
