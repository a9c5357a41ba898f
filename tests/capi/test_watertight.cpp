// SPDX-License-Identifier: Apache-2.0
// Rays from inside of a closed surface never escape; threads trace while others build and release.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "capi/handles.h"
#include "support/closed_meshes.h"

namespace sobb::test {
namespace {

constexpr uint32_t kVolumes[] = {SOBB_VOLUME_AABB, SOBB_VOLUME_SOBB};

TEST(Watertight, RaysFromInsideNeverEscape) {
  constexpr uint64_t kSeed = 31;
  for (const ClosedMesh& mesh : closed_meshes()) {
    const std::vector<sobb_ray> rays = rays_from_inside(mesh, kSeed, 10'000);
    for (const uint32_t volume : kVolumes) {
      for (const uint32_t quality : {SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH}) {
        const HierarchyHandle hierarchy = build_soup(mesh.soup, build_options(volume, quality));
        for (const uint32_t flags : {0U, static_cast<uint32_t>(SOBB_TRACE_COHERENT)}) {
          const std::vector<sobb_hit> hits = trace(hierarchy, rays, trace_options(flags));
          for (size_t i = 0; i < hits.size(); ++i) {
            ASSERT_NE(hits[i].primitive, SOBB_MISS)
                << mesh.soup.name << " seed " << kSeed << " ray " << i << " volume " << volume;
          }
        }
      }
    }
  }
}

TEST(Threads, TraceBuildAndReleaseAtOnce) {
  const Soup soup = random_soup(32, 3000);
  const HierarchyHandle shared = build_soup(soup);
  const std::vector<sobb_ray> rays = mixed_rays(soup, 33, 3000);
  const std::vector<sobb_hit> expected = trace(shared, rays);
  std::atomic<int> different{0};
  std::vector<std::thread> threads;
  threads.reserve(4);
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&, thread] {
      for (int round = 0; round < 8; ++round) {
        sobb_retain(shared.get());
        const uint32_t flags = round % 2 == 0 ? 0 : SOBB_TRACE_COHERENT;
        different += !same(trace(shared, rays, trace_options(flags, 1 + thread % 2)), expected);
        const HierarchyHandle own =
            build_soup(soup, build_options(kVolumes[round % 2], 1 + thread % 3, thread % 3));
        different += !same(trace(own, rays), expected);
        different += info_of(shared).triangles != 3000;
        sobb_release(shared.get());
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(different, 0);
}

// The last release may be any thread's.
TEST(Threads, ReleaseTheLastReference) {
  for (int round = 0; round < 50; ++round) {
    sobb_hierarchy* hierarchy = build_soup(random_soup(34, 20)).release();
    std::vector<std::thread> threads;
    threads.reserve(4);
    for (int thread = 0; thread < 4; ++thread) {
      sobb_retain(hierarchy);
      threads.emplace_back([hierarchy] { sobb_release(hierarchy); });
    }
    sobb_release(hierarchy);
    for (std::thread& thread : threads) thread.join();
  }
}

}  // namespace
}  // namespace sobb::test
