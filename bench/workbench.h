// SPDX-License-Identifier: Apache-2.0
// Workbench holds all that the rows share. It makes each part when a row first needs it.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "flags.h"
#include "peer.h"
#include "ray_sets.h"
#include "scene_input.h"
#include "sobb_subject.h"
#include "workers.h"

namespace sobb::bench {

class Workbench {
 public:
  explicit Workbench(const Flags& flags);
  Workbench(const Workbench&) = delete;
  Workbench& operator=(const Workbench&) = delete;
  ~Workbench();

  const Flags& flags() const { return flags_; }
  const SceneInput& scene() const { return scene_; }
  Workers& workers() { return workers_; }
  TraceOutput& output() { return output_; }

  // Hierarchies that are traced are built with all threads: only `build` rows measure the build.
  const SobbSubject& subject(Method method);
  /// Only where peer_library() is there.
  Peer& peer(Method method);
  const RaySet& rays(RayKind kind);
  /// Counted once, in a pass of its own.
  const WorkPerRay& work(RayKind kind, Method method);
  double per_triangle(uint64_t bytes) const {
    return static_cast<double>(bytes) / static_cast<double>(scene_.info().triangle_count);
  }
  /// The SOBB hierarchy as a file, in a folder of its own that the destructor removes.
  const std::filesystem::path& saved_file();

  // What has been made so far.
  const std::map<Method, SobbSubject>& subjects() const { return subjects_; }
  const std::map<Method, std::unique_ptr<Peer>>& peers() const { return peers_; }
  const std::map<RayKind, RaySet>& ray_sets() const { return ray_sets_; }

 private:
  RaySet make_rays(RayKind kind);
  std::vector<sobb_hit> closest_hits(const RaySet& set);
  Surface surface();

  const Flags& flags_;
  SceneInput scene_;
  Workers workers_;
  TraceOutput output_;
  std::map<Method, SobbSubject> subjects_;
  std::map<Method, std::unique_ptr<Peer>> peers_;
  std::map<RayKind, RaySet> ray_sets_;
  std::map<std::pair<RayKind, Method>, WorkPerRay> work_;
  std::filesystem::path saved_file_;
};

}  // namespace sobb::bench
