// SPDX-License-Identifier: Apache-2.0
// The benchmark's secondary rays: every bounce of a path.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "ray_sets.h"
#include "sobb/scene.h"

namespace sobb::test {
namespace {

using bench::RaySet;
using bench::Vec3;

constexpr uint32_t kBounces = 7;

class Paths : public testing::Test {
 protected:
  void SetUp() override {
    sobb_scene* scene = nullptr;
    ASSERT_EQ(sobb_scene_load("builtin:city:5000", nullptr, &scene), SOBB_OK) << sobb_last_error();
    scene_.reset(scene, sobb_scene_release);
    triangles_.struct_size = sizeof triangles_;
    info_.struct_size = sizeof info_;
    ASSERT_EQ(sobb_scene_triangles(scene, &triangles_), SOBB_OK);
    ASSERT_EQ(sobb_scene_get_info(scene, &info_), SOBB_OK);
    sobb_view view;
    ASSERT_EQ(sobb_scene_view(scene, 0, &view), SOBB_OK);
    primary_ = bench::primary_rays(view, 128);
  }

  bench::ClosestHits hits_by(uint32_t volume, uint32_t threads) const {
    sobb_build_options options = {};
    options.struct_size = sizeof options;
    options.volume = volume;
    sobb_hierarchy* handle = nullptr;
    EXPECT_EQ(sobb_build(&triangles_, &options, &handle), SOBB_OK) << sobb_last_error();
    const std::shared_ptr<sobb_hierarchy> hierarchy(handle, sobb_release);
    return [hierarchy, threads](const RaySet& set) {
      std::vector<sobb_hit> hits(set.rays.size());
      sobb_trace_options trace = {};
      trace.struct_size = sizeof trace;
      trace.threads = threads;
      EXPECT_EQ(sobb_intersect(hierarchy.get(), set.rays.data(), hits.size(), hits.data(), &trace),
                SOBB_OK);
      return hits;
    };
  }

  std::vector<sobb_ray> paths(uint32_t bounces, const bench::ClosestHits& hits) const {
    return bench::path_rays(triangles_, info_, primary_, bounces, hits).rays;
  }

  Vec3 corner(uint32_t primitive, size_t i) const {
    const size_t stride = triangles_.vertex_stride == 0 ? 12 : triangles_.vertex_stride;
    const size_t vertex = triangles_.indices[3 * size_t{primitive} + i];
    return bench::load(triangles_.vertices + vertex * stride / sizeof(float));
  }

  std::shared_ptr<sobb_scene> scene_;
  sobb_triangles triangles_ = {};
  sobb_scene_info info_ = {};
  RaySet primary_{bench::RayKind::kPrimary, {}};
};

bool same(const std::vector<sobb_ray>& a, const std::vector<sobb_ray>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

// Every bounce has one ray per hit, of unit length. The ray starts just off the triangle, on the
// side that the ray before came from, and leaves it by the cosine, whose mean is 2/3.
TEST_F(Paths, LeaveTheSurfaceByTheCosine) {
  const bench::ClosestHits hits_of = hits_by(SOBB_VOLUME_AABB, 2);
  RaySet before = primary_;
  for (uint32_t bounce = 1; bounce <= 3; ++bounce) {
    const std::vector<sobb_hit> hits = hits_of(before);
    const RaySet after =
        bench::diffuse_rays(bench::surface_of(triangles_, info_, before, hits), bounce);
    size_t next = 0;
    double cosines = 0;
    for (size_t i = 0; i < hits.size(); ++i) {
      if (hits[i].primitive == SOBB_MISS) continue;
      ASSERT_LT(next, after.rays.size());
      const sobb_ray& ray = after.rays[next++];
      const Vec3 direction = bench::load(ray.direction);
      ASSERT_NEAR(bench::length(direction), 1, 1e-6);
      ASSERT_EQ(ray.tmin, 0);
      ASSERT_TRUE(std::isinf(ray.tmax));
      const Vec3 first = corner(hits[i].primitive, 0);
      const Vec3 normal = bench::normalized(
          bench::cross(corner(hits[i].primitive, 1) - first, corner(hits[i].primitive, 2) - first));
      const double side = bench::dot(normal, bench::load(before.rays[i].direction)) > 0 ? -1 : 1;
      ASSERT_GT(side * bench::dot(normal, bench::load(ray.origin) - first), 0)
          << "bounce " << bounce;
      ASSERT_GT(side * bench::dot(normal, direction), -1e-6);
      cosines += side * bench::dot(normal, direction);
    }
    ASSERT_EQ(next, after.rays.size());
    ASSERT_GT(next, 1000U);
    // The deviation of a cosine is 0.24, so this is more than four of the mean's.
    EXPECT_NEAR(cosines / static_cast<double>(next), 2.0 / 3, 1.0 / std::sqrt(next));
    before = after;
  }
}

TEST_F(Paths, AreTheSameByEveryHierarchy) {
  const std::vector<sobb_ray> expected = paths(kBounces, hits_by(SOBB_VOLUME_AABB, 1));
  EXPECT_TRUE(same(paths(kBounces, hits_by(SOBB_VOLUME_SOBB, 2)), expected));
}

TEST_F(Paths, AreBounceAfterBounce) {
  const bench::ClosestHits hits_of = hits_by(SOBB_VOLUME_AABB, 2);
  const std::vector<sobb_hit> hits = hits_of(primary_);
  const bench::Surface surface = bench::surface_of(triangles_, info_, primary_, hits);
  EXPECT_TRUE(same(paths(1, hits_of), bench::diffuse_rays(surface).rays));
  EXPECT_FALSE(same(bench::diffuse_rays(surface, 2).rays, bench::diffuse_rays(surface, 1).rays));

  const std::vector<sobb_ray> all = paths(kBounces, hits_of);
  size_t longest = primary_.rays.size();
  size_t before = 0;
  for (uint32_t bounces = 1; bounces <= kBounces; ++bounces) {
    const std::vector<sobb_ray> some = paths(bounces, hits_of);
    ASSERT_LE(some.size() - before, longest) << "a path never comes back";
    ASSERT_TRUE(same(some, {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(some.size())}));
    longest = some.size() - before;
    before = some.size();
  }
  EXPECT_EQ(before, all.size());
}

TEST_F(Paths, OfAViewOfNothingAreNone) {
  for (sobb_ray& ray : primary_.rays) {
    for (float& x : ray.direction) x = -x;  // the default view looks at the scene from outside
  }
  EXPECT_TRUE(paths(kBounces, hits_by(SOBB_VOLUME_AABB, 1)).empty());
}

}  // namespace
}  // namespace sobb::test
