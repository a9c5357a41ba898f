// SPDX-License-Identifier: Apache-2.0
// Workbench holds all that the rows share. It makes everything, and compares all hits, before the
// first row is timed.
#pragma once

#include <memory>
#include <vector>

#include "bench_volumes/options.h"
#include "bench_volumes/ray_groups.h"
#include "bench_volumes/subject.h"
#include "scene_input.h"
#include "stopwatch.h"
#include "volumes/hierarchy.h"

namespace sobb::bench::volumes {

/// Milliseconds of one build of the topology.
struct TopologyTimes {
  double topology = 0;
  double layout[2] = {};  // binary, wide

  double layout_of(uint32_t width) const { return layout[width == 2 ? 0 : 1]; }
};

class Workbench {
 public:
  /// Throws, naming method and ray, where a method's hits differ from the first method's, or those
  /// from brute force's.
  explicit Workbench(const Options& options);

  const Options& options() const { return options_; }
  const SceneInput& scene() const { return scene_; }
  const study::SharedTopology& topology() const { return *topology_; }
  const std::vector<TopologyTimes>& topology_times() const { return topology_times_; }
  const RayGroups& groups() const { return groups_; }
  const std::vector<Subject>& subjects() const { return subjects_; }
  uint64_t brute_force_rays() const { return brute_force_rays_; }

  /// The AABB's subject of that width.
  const Subject& boxes(uint32_t width) const;

  /// Milliseconds of one more conversion, which is not kept.
  double convert_anew(const Subject& subject) const;
  /// Seconds of one pass. Throws where its hits differ from the group's.
  double trace(const Subject& subject, const RayGroup& group);

 private:
  void build_topology();
  void add_subject(const study::ConvertSettings& settings);
  void make_rays();
  void count_work(Subject& subject);
  double pass(const Subject& subject, const RayGroup& group, sobb_count* counts);

  const Options& options_;
  SceneInput scene_;
  Scheduler scheduler_;
  Stopwatch clock_;
  std::unique_ptr<study::SharedTopology> topology_;
  std::vector<TopologyTimes> topology_times_;
  std::vector<Subject> subjects_;
  RayGroups groups_;
  uint64_t brute_force_rays_ = 0;
  std::vector<sobb_hit> hits_;  // of the last pass
};

}  // namespace sobb::bench::volumes
