// SPDX-License-Identifier: Apache-2.0
// StudyScene holds the checked triangles of a scene, and makes rays that depend on no hierarchy.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/memory.h"
#include "base/scheduler.h"
#include "builder/mesh.h"
#include "builder/topology/topology.h"
#include "sobb/scene.h"
#include "sobb/sobb.h"
#include "study/report.h"
#include "study/study_options.h"
#include "volumes/box_area.h"

namespace sobb::study {

class StudyScene {
 public:
  StudyScene(const std::string& source, const StudyOptions& options);

  const std::string& name() const { return name_; }  // a file's name without its folder
  const sobb_triangles& triangles() const { return triangles_; }
  const Mesh& mesh() const { return *mesh_; }
  const MeshSummary& summary() const { return summary_; }
  double box_area() const { return study::box_area(summary_); }
  const Scheduler& scheduler() const { return scheduler_; }
  Memory& memory() { return *memory_; }

  // Builds a binary topology of medium quality, as the library does.
  Topology build_topology(const Frame& frame = Frame());
  // One ray for each of size x size pixels of the first view.
  std::vector<sobb_ray> primary_rays(uint32_t size) const;
  // All bounces 1 to 7 of a path tracer, one path for each of size x size pixels of the first view.
  std::vector<sobb_ray> secondary_rays(uint32_t size) const;
  // {"scene", "triangles"}, for a report.
  Json description() const;

 private:
  sobb_view view() const;

  std::string name_;
  Scheduler scheduler_;
  std::shared_ptr<Memory> memory_;
  std::shared_ptr<sobb_scene> scene_;
  sobb_triangles triangles_ = SOBB_TRIANGLES_INIT;
  std::unique_ptr<Mesh> mesh_;
  MeshSummary summary_{};
};

// Answers a question about each scene in turn. Only one scene is held at a time.
template <class Answer>
Json for_each_scene(const StudyOptions& options, const Answer& answer) {
  Json scenes = Json::array();
  for (const std::string& source : options.scenes) {
    StudyScene scene(source, options);
    Json figures = scene.description();
    figures.update(answer(scene));
    scenes.push_back(figures);
  }
  return scenes;
}

}  // namespace sobb::study
