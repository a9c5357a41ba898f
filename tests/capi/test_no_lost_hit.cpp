// SPDX-License-Identifier: Apache-2.0
// Rays made to be lost (docs/robustness.md): every way to trace them returns the oracle's bits, and
// so do rays that end or begin exactly at their hits.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "capi/every_call.h"
#include "capi/random_bases.h"
#include "support/hostile_rays.h"
#include "support/sanitized.h"

namespace sobb::test {
namespace {

// The direction table of the file that a hierarchy is (docs/format.md).
std::vector<std::array<float, 3>> normals_of(const HierarchyHandle& hierarchy) {
  const std::string bytes = bytes_of(hierarchy);
  const auto read = [&](size_t at, auto value) {
    std::memcpy(&value, &bytes[at], sizeof value);
    return value;
  };
  std::vector<std::array<float, 3>> normals(read(48, uint32_t{0}));
  for (size_t section = 128;; section += 32) {
    if (read(section, uint32_t{0}) != 1) continue;
    std::memcpy(normals.data(), &bytes[read(section + 8, uint64_t{0})], normals.size() * 12);
    return normals;
  }
}

std::string describe(const Soup& soup, RayFamily family, const sobb_build_options& options,
                     uint64_t seed) {
  return soup.name + " seed " + std::to_string(seed) + " family " +
         std::to_string(static_cast<int>(family)) + " volume " + std::to_string(options.volume) +
         " quality " + std::to_string(options.quality) + " width " + std::to_string(options.width);
}

// Rays that hit end, or begin, at that very t; where another hit is as near it may be theirs.
std::vector<sobb_ray> cut_at_hits(std::vector<sobb_ray> rays, const std::vector<sobb_hit>& hits) {
  for (size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].primitive == SOBB_MISS) continue;
    (i % 2 == 0 ? rays[i].tmax : rays[i].tmin) = hits[i].t;
  }
  return rays;
}

// The families that hierarchy `index` of a soup is traced with. Under a sanitizer they are every
// third, another third than of the hierarchy before, so that each family still meets every volume.
std::vector<RayFamily> families(size_t index) {
  if (!kSanitized) return {kRayFamilies.begin(), kRayFamilies.end()};
  std::vector<RayFamily> third;
  for (size_t i = index % 3; i < kRayFamilies.size(); i += 3) third.push_back(kRayFamilies[i]);
  return third;
}

class NoLostHit : public testing::TestWithParam<Soup> {};

TEST_P(NoLostHit, WhateverStrainsTheBounds) {
  const Soup& soup = GetParam();
  constexpr uint32_t kRays = 320;  // enough for batches
  uint64_t seed = 4100;
  size_t hierarchies = 0;
  for (const uint32_t volume : {SOBB_VOLUME_AABB, SOBB_VOLUME_SOBB}) {
    for (const uint32_t quality : {SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH}) {
      for (const uint32_t width : {4U, 8U}) {
        sobb_build_options options = build_options(volume, quality);
        options.width = width;
        const HierarchyHandle hierarchy = build_soup(soup, options);
        ASSERT_TRUE(hierarchy);
        const auto normals = normals_of(hierarchy);
        for (const RayFamily family : families(hierarchies++)) {
          ++seed;
          const std::string what = describe(soup, family, options, seed);
          const std::vector<sobb_ray> rays = hostile_rays(soup, family, normals, seed, kRays);
          const std::vector<sobb_hit> expected = oracle(soup, rays);
          const std::vector<sobb_ray> cut = cut_at_hits(rays, expected);
          const std::vector<sobb_hit> expected_of_cut = oracle(soup, cut);
          check_calls(hierarchy, rays, expected, what);
          check_calls(hierarchy, cut, expected_of_cut, what + " cut");
          if (volume == SOBB_VOLUME_AABB) continue;
          const HierarchyHandle rebound = with_random_bases(hierarchy, seed);
          check_calls(rebound, rays, expected, what + " random bases");
          check_calls(rebound, cut, expected_of_cut, what + " random bases, cut");
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Soups, NoLostHit,
    testing::Values(random_soup(41, 400), random_soup(42, 300, 1e-3), sliver_soup(43, 300),
                    closed_box(7), turned_boxes(44, 30), degenerate_soup(45, 300),
                    placed(random_soup(46, 300), 1, 1e3), placed(turned_boxes(47, 20), 1, 1e6),
                    placed(sliver_soup(48, 200), 1e-6, 0), placed(random_soup(49, 200), 1e6, -3e7),
                    placed(random_soup(50, 200), 1e-30, 0), placed(closed_box(5), 0x1p55, 0x1p58)),
    [](const testing::TestParamInfo<Soup>& info) { return "soup" + std::to_string(info.index); });

}  // namespace
}  // namespace sobb::test
