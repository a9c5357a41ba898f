// SPDX-License-Identifier: Apache-2.0
// The workbench builds, converts, makes the rays and compares the hits.
#include "bench_volumes/workbench.h"

#include <algorithm>
#include <utility>

#include "bench_volumes/repetitions.h"

namespace sobb::bench::volumes {

Workbench::Workbench(const Options& options)
    : options_(options),
      scene_(options.scene, options.cameras, options.view),
      scheduler_(options.threads, nullptr),
      clock_(options.threads) {
  build_topology();
  for (const uint32_t width : options.widths) {
    for (const study::ConvertSettings& settings : settings_of(options, width)) {
      add_subject(settings);
    }
  }
}

// Builds as often as a row is repeated. Building later would hold two topologies in memory.
void Workbench::build_topology() {
  const auto memory = std::make_shared<Memory>();
  int count = 1;
  for (int i = 0; i < count; ++i) {
    topology_.reset();
    topology_ = std::make_unique<study::SharedTopology>(scene_.triangles(), scheduler_, memory);
    const TopologyTimes times{topology_->topology_ms(),
                              {topology_->layout_ms(2), topology_->layout_ms(8)}};
    topology_times_.push_back(times);
    const double ms = times.topology + times.layout[0] + times.layout[1];
    if (i == 0) count = repetitions(options_.cell_seconds, 1e-3 * ms, kFewestBuilds).count;
  }
}

void Workbench::add_subject(const study::ConvertSettings& settings) {
  study::Hierarchy hierarchy(*topology_, settings, scheduler_);
  const study::Areas areas = hierarchy.areas(scheduler_);
  subjects_.push_back({settings, std::move(hierarchy), areas});
  if (subjects_.size() == 1) make_rays();
  count_work(subjects_.back());
}

// The first method traces the paths; all others are compared with its hits.
void Workbench::make_rays() {
  const Subject& first = subjects_.front();
  const auto hits_of = [&](const std::vector<sobb_ray>& rays) {
    std::vector<sobb_hit> hits(rays.size());
    first.hierarchy.intersect(rays.data(), rays.size(), hits.data(), nullptr, scheduler_);
    return hits;
  };
  groups_ =
      make_ray_groups(scene_, options_.size, [&](const RaySet& set) { return hits_of(set.rays); });
  for (RayGroup& group : groups_) {
    group.hits = hits_of(group.rays);
    brute_force_rays_ +=
        expect_brute_force(first.name(), group, scene_.triangles(), options_.threads);
  }
}

void Workbench::count_work(Subject& subject) {
  for (size_t i = 0; i < kGroups; ++i) {
    const RayGroup& group = groups_[i];
    Work& work = subject.work[i];
    std::vector<sobb_count> counts(group.rays.size());
    work.seconds = pass(subject, group, counts.data());
    const double share = 1 / static_cast<double>(counts.size());
    for (const sobb_count& count : counts) {
      work.nodes += share * count.nodes;
      work.volumes += share * count.volumes;
      work.triangles += share * count.triangles;
    }
  }
}

const Subject& Workbench::boxes(uint32_t width) const {
  return *std::find_if(subjects_.begin(), subjects_.end(), [&](const Subject& subject) {
    return subject.settings.width == width &&
           subject.settings.method.volume == study::VolumeKind::kAabb;
  });
}

double Workbench::convert_anew(const Subject& subject) const {
  return study::Hierarchy(*topology_, subject.settings, scheduler_).convert_ms();
}

double Workbench::trace(const Subject& subject, const RayGroup& group) {
  return pass(subject, group, nullptr);
}

double Workbench::pass(const Subject& subject, const RayGroup& group, sobb_count* counts) {
  hits_.resize(group.rays.size());
  const double seconds = clock_.seconds_of([&] {
    subject.hierarchy.intersect(group.rays.data(), group.rays.size(), hits_.data(), counts,
                                scheduler_);
  });
  expect_same_hits(subject.name(), group, hits_);
  return seconds;
}

}  // namespace sobb::bench::volumes
