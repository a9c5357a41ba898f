// SPDX-License-Identifier: Apache-2.0
// Rays from inside of a closed surface never escape; threads trace while others build and release.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>
#include <thread>

#include "capi/handles.h"

namespace sobb::test {
namespace {

constexpr uint32_t kVolumes[] = {SOBB_VOLUME_AABB, SOBB_VOLUME_SOBB};

// A closed sphere of rings and poles, each vertex shared by all its triangles.
Soup sphere(uint32_t rings, uint32_t sides) {
  Soup soup{"sphere", {}, {}};
  const auto add = [&](double polar, double turn) {
    for (const double x :
         {std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)}) {
      soup.vertices.push_back(static_cast<float>(0.5 + 0.5 * x));
    }
  };
  for (uint32_t ring = 1; ring < rings; ++ring) {
    for (uint32_t side = 0; side < sides; ++side) {
      add(std::numbers::pi * ring / rings, 2 * std::numbers::pi * side / sides);
    }
  }
  add(0, 0);
  add(std::numbers::pi, 0);
  const uint32_t top = (rings - 1) * sides;
  const auto at = [&](uint32_t ring, uint32_t side) {
    if (ring == 0) return top;
    if (ring == rings) return top + 1;
    return (ring - 1) * sides + side % sides;
  };
  for (uint32_t ring = 0; ring < rings; ++ring) {
    for (uint32_t side = 0; side < sides; ++side) {
      const uint32_t a = at(ring, side);
      const uint32_t b = at(ring, side + 1);
      const uint32_t c = at(ring + 1, side);
      const uint32_t d = at(ring + 1, side + 1);
      if (ring > 0) soup.indices.insert(soup.indices.end(), {a, b, d});
      if (ring + 1 < rings) soup.indices.insert(soup.indices.end(), {a, d, c});
    }
  }
  return soup;
}

// From inside the sphere of radius 0.45 about the middle: anywhere, at vertices, at edges' middles.
std::vector<sobb_ray> rays_from_inside(const Soup& soup, uint64_t seed, size_t count) {
  Random random(seed);
  std::vector<sobb_ray> rays(count);
  for (sobb_ray& ray : rays) {
    double square;
    do {
      square = 0;
      for (float& value : ray.origin) {
        value = random.between(0.05, 0.95);
        square += (value - 0.5) * (value - 0.5);
      }
    } while (square > 0.45 * 0.45);
    const auto triangle = random.below(static_cast<uint32_t>(soup.indices.size() / 3));
    const uint32_t kind = random.below(3);
    bool zero = true;
    for (int k = 0; k < 3; ++k) {
      const float* a = soup.corner(triangle, 0);
      const float* b = soup.corner(triangle, 1);
      const float target = kind == 0 ? a[k] : kind == 1 ? (a[k] + b[k]) / 2 : random.between(-1, 2);
      ray.direction[k] = target - ray.origin[k];
      zero = zero && ray.direction[k] == 0;
    }
    if (zero) ray.direction[0] = 1;
    ray.tmin = 0;
    ray.tmax = std::numeric_limits<float>::infinity();
  }
  return rays;
}

TEST(Watertight, RaysFromInsideNeverEscape) {
  constexpr uint64_t kSeed = 31;
  for (const Soup& soup : {closed_box(16), sphere(40, 60)}) {
    const std::vector<sobb_ray> rays = rays_from_inside(soup, kSeed, 50'000);
    for (const uint32_t volume : kVolumes) {
      for (const uint32_t quality : {SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH}) {
        const HierarchyHandle hierarchy = build_soup(soup, build_options(volume, quality));
        for (const uint32_t flags : {0U, static_cast<uint32_t>(SOBB_TRACE_COHERENT)}) {
          const std::vector<sobb_hit> hits = trace(hierarchy, rays, trace_options(flags));
          for (size_t i = 0; i < hits.size(); ++i) {
            ASSERT_NE(hits[i].primitive, SOBB_MISS)
                << soup.name << " seed " << kSeed << " ray " << i << " volume " << volume;
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
