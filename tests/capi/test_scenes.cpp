// SPDX-License-Identifier: Apache-2.0
// On whole scenes, the built-in ones and those in the folder SOBB_SCENES: every volume, k, width,
// instruction set, call and thread count returns the same bits, and some equal brute force.
// SOBB_TEST_RAYS is how many rays of each kind, at least (20,000 unless set).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "ray_sets.h"
#include "sobb/scene.h"
#include "support/more_threads.h"
#include "support/supported_isas.h"

namespace sobb::test {
namespace {

// Larger real scenes are passed over: brute force and sixteen builds of each take too long.
constexpr uint64_t kMostTriangles = 1'200'000;
constexpr uint64_t kBruteForceRays = 200;
constexpr uint64_t kBruteForceRaysOfSmall = 20'000;
constexpr uint64_t kSmall = 10'000;

struct Release {
  void operator()(sobb_hierarchy* hierarchy) const { sobb_release(hierarchy); }
  void operator()(sobb_scene* scene) const { sobb_scene_release(scene); }
};
using Hierarchy = std::unique_ptr<sobb_hierarchy, Release>;
using SceneHandle = std::unique_ptr<sobb_scene, Release>;

std::vector<std::string> scenes() {
  std::vector<std::string> names;
  for (const char* name : {"hairball", "wool", "pipes", "foliage", "city", "terrain"}) {
    names.push_back(std::string("builtin:") + name + ":60000");
  }
  names.emplace_back("builtin:city:10000@30");
  const char* folder = std::getenv("SOBB_SCENES");
  if (folder == nullptr) return names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".glb") names.push_back(entry.path().string());
  }
  std::sort(names.begin() + 7, names.end());
  return names;
}

uint32_t image_size() {
  const char* rays = std::getenv("SOBB_TEST_RAYS");
  const double wanted = rays == nullptr ? 20'000 : std::strtod(rays, nullptr);
  return (static_cast<uint32_t>(std::ceil(std::sqrt(wanted))) + 7) / 8 * 8;
}

// The scene, its rays of every kind in one array, and their hits as the first way gave them.
class Scenes : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    sobb_scene* handle = nullptr;
    ASSERT_EQ(sobb_scene_load(GetParam().c_str(), nullptr, &handle), SOBB_OK) << sobb_last_error();
    scene_.reset(handle);
    triangles_.struct_size = sizeof triangles_;
    ASSERT_EQ(sobb_scene_triangles(scene_.get(), &triangles_), SOBB_OK);
    if (triangles_.triangle_count > kMostTriangles) {
      GTEST_SKIP() << GetParam() << " has " << triangles_.triangle_count << " triangles";
    }
    const Hierarchy hierarchy = build(SOBB_VOLUME_AABB, 0, 8);
    make_rays(hierarchy.get());
  }

  Hierarchy build(uint32_t volume, uint32_t k, uint32_t width) const {
    sobb_build_options options = {};
    options.struct_size = sizeof options;
    options.volume = volume;
    options.k = k;
    options.width = width;
    sobb_hierarchy* handle = nullptr;
    EXPECT_EQ(sobb_build(&triangles_, &options, &handle), SOBB_OK) << sobb_last_error();
    return Hierarchy(handle);
  }

  std::vector<sobb_hit> trace(const sobb_hierarchy* hierarchy, uint32_t isa, uint32_t flags,
                              uint32_t threads, const std::vector<sobb_ray>& rays) const {
    std::vector<sobb_hit> hits(rays.size());
    const sobb_trace_options options = {sizeof options, flags,   threads, isa,
                                        nullptr,        nullptr, nullptr};
    EXPECT_EQ(sobb_intersect(hierarchy, rays.data(), rays.size(), hits.data(), &options), SOBB_OK)
        << sobb_last_error();
    return hits;
  }

  void make_rays(const sobb_hierarchy* hierarchy) {
    sobb_scene_info info = {};
    info.struct_size = sizeof info;
    ASSERT_EQ(sobb_scene_get_info(scene_.get(), &info), SOBB_OK);
    sobb_view view;
    ASSERT_EQ(sobb_scene_view(scene_.get(), 0, &view), SOBB_OK);
    const bench::RaySet primary = bench::primary_rays(view, image_size());
    const std::vector<sobb_hit> hits = trace(hierarchy, SOBB_ISA_SSE4, 0, 1, primary.rays);
    const bench::Surface surface = bench::surface_of(triangles_, info, primary, hits);
    for (const bench::RaySet& set :
         {primary, bench::diffuse_rays(surface), bench::random_rays(info, primary.rays.size())}) {
      rays_.insert(rays_.end(), set.rays.begin(), set.rays.end());
    }
    expected_ = trace(hierarchy, SOBB_ISA_SSE4, 0, 1, rays_);
  }

  void expect_same(const std::vector<sobb_hit>& hits, const std::string& what) const {
    for (size_t i = 0; i < hits.size(); ++i) {
      if (std::memcmp(&hits[i], &expected_[i], sizeof hits[i]) == 0) continue;
      FAIL() << what << ": ray " << i << " hits " << hits[i].primitive << " at " << hits[i].t
             << ", not " << expected_[i].primitive << " at " << expected_[i].t;
    }
  }

  SceneHandle scene_;
  sobb_triangles triangles_ = {};
  std::vector<sobb_ray> rays_;
  std::vector<sobb_hit> expected_;
};

TEST_P(Scenes, EqualBruteForce) {
  const uint64_t wanted =
      triangles_.triangle_count <= kSmall ? kBruteForceRaysOfSmall : kBruteForceRays;
  const size_t step = rays_.size() > wanted ? rays_.size() / wanted : 1;
  std::vector<sobb_ray> some;
  for (size_t i = 0; i < rays_.size(); i += step) some.push_back(rays_[i]);
  std::vector<sobb_hit> hits(some.size());
  ASSERT_EQ(sobb_brute_force(&triangles_, some.data(), some.size(), hits.data(), nullptr), SOBB_OK);
  for (size_t i = 0; i < some.size(); ++i) {
    ASSERT_EQ(std::memcmp(&hits[i], &expected_[i * step], sizeof hits[i]), 0)
        << "ray " << i * step << " hits " << expected_[i * step].primitive << ", not "
        << hits[i].primitive;
  }
}

TEST_P(Scenes, AreTheSameEveryWay) {
  // More threads than this machine may have: three really run.
  const MoreThreads limit(4);
  std::vector<uint8_t> occluded(rays_.size());
  for (const uint32_t k : {0U, 32U, 48U, 64U}) {
    for (const uint32_t width : {4U, 8U}) {
      const Hierarchy hierarchy = build(k == 0 ? SOBB_VOLUME_AABB : SOBB_VOLUME_SOBB, k, width);
      ASSERT_TRUE(hierarchy);
      const std::string what = "k " + std::to_string(k) + " width " + std::to_string(width);
      for (const sobb_isa isa : supported_isas()) {
        const std::string way = what + " isa " + std::to_string(isa);
        expect_same(trace(hierarchy.get(), isa, 0, 1, rays_), way);
        expect_same(trace(hierarchy.get(), isa, SOBB_TRACE_COHERENT, 3, rays_), way + " packets");
      }
      expect_same(trace(hierarchy.get(), SOBB_ISA_BEST, 0, 3, rays_), what + " three threads");
      const sobb_trace_options options = {sizeof options, 0, 3, 0, nullptr, nullptr, nullptr};
      ASSERT_EQ(
          sobb_occluded(hierarchy.get(), rays_.data(), rays_.size(), occluded.data(), &options),
          SOBB_OK);
      for (size_t i = 0; i < rays_.size(); ++i) {
        ASSERT_EQ(occluded[i], expected_[i].primitive == SOBB_MISS ? SOBB_FREE : SOBB_OCCLUDED)
            << what << ": any hit of ray " << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Each, Scenes, testing::ValuesIn(scenes()),
                         [](const testing::TestParamInfo<std::string>& info) {
                           const size_t file = info.param.find_last_of('/') + 1;
                           const size_t builtin = info.param.starts_with("builtin:") ? 8 : 0;
                           std::string name = info.param.substr(std::max(file, builtin));
                           for (char& c : name) {
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           }
                           return name;
                         });

}  // namespace
}  // namespace sobb::test
