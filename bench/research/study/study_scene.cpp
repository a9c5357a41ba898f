// SPDX-License-Identifier: Apache-2.0
#include "study/study_scene.h"

#include <filesystem>
#include <iostream>

#include "check.h"
#include "ray_sets.h"

namespace sobb::study {

using bench::check;

namespace {

constexpr uint32_t kBounces = 7;  // as the paper counts secondary rays

}  // namespace

StudyScene::StudyScene(const std::string& source, const StudyOptions& options)
    : name_(source.starts_with("builtin:") ? source
                                           : std::filesystem::path(source).filename().string()),
      scheduler_(options.threads, nullptr),
      memory_(std::make_shared<Memory>()) {
  std::cerr << name_ << "\n";
  sobb_scene* scene = nullptr;
  check(sobb_scene_load(source.c_str(), nullptr, &scene));
  scene_.reset(scene, sobb_scene_release);
  check(sobb_scene_triangles(scene, &triangles_));
  mesh_ = std::make_unique<Mesh>(triangles_, scheduler_);
  summary_ = summarise(*mesh_, scheduler_, *memory_);
}

Topology StudyScene::build_topology(const Frame& frame) {
  Progress progress(nullptr, nullptr);
  return Topology(*mesh_, SOBB_QUALITY_MEDIUM, scheduler_, *memory_, progress, /*progress_end=*/1,
                  frame);
}

sobb_view StudyScene::view() const {
  sobb_view view{};
  check(sobb_scene_view(scene_.get(), 0, &view));
  return view;
}

std::vector<sobb_ray> StudyScene::primary_rays(uint32_t size) const {
  return bench::primary_rays(view(), size).rays;
}

std::vector<sobb_ray> StudyScene::secondary_rays(uint32_t size) const {
  sobb_scene_info info = SOBB_SCENE_INFO_INIT;
  check(sobb_scene_get_info(scene_.get(), &info));

  sobb_hierarchy* built = nullptr;
  check(sobb_build(&triangles_, nullptr, &built));
  const std::shared_ptr<sobb_hierarchy> hierarchy(built, sobb_release);
  const auto closest_hits = [&](const bench::RaySet& set) {
    std::vector<sobb_hit> hits(set.rays.size());
    check(sobb_intersect(built, set.rays.data(), hits.size(), hits.data(), nullptr));
    return hits;
  };
  return bench::path_rays(triangles_, info, bench::primary_rays(view(), size), kBounces,
                          closest_hits)
      .rays;
}

Json StudyScene::description() const {
  return {{"scene", name_}, {"triangles", triangles_.triangle_count}};
}

}  // namespace sobb::study
