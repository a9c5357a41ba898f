// SPDX-License-Identifier: Apache-2.0
// Every way to trace returns the oracle's bits: volumes, k, widths, qualities, strategies,
// instruction sets, calls.
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <memory>
#include <vector>

#include "support/soups.h"

namespace sobb::test {
namespace {

struct Release {
  void operator()(sobb_hierarchy* hierarchy) const { sobb_release(hierarchy); }
};
using Handle = std::unique_ptr<sobb_hierarchy, Release>;

Handle build(const Soup& soup, const sobb_build_options& options) {
  sobb_hierarchy* hierarchy = nullptr;
  const sobb_triangles triangles = soup.view();
  EXPECT_EQ(sobb_build(&triangles, &options, &hierarchy), SOBB_OK) << sobb_last_error();
  return Handle(hierarchy);
}

std::vector<sobb_hit> oracle(const Soup& soup, const std::vector<sobb_ray>& rays) {
  std::vector<sobb_hit> hits(rays.size());
  const sobb_triangles triangles = soup.view();
  EXPECT_EQ(sobb_brute_force(&triangles, rays.data(), rays.size(), hits.data(), nullptr), SOBB_OK);
  return hits;
}

std::string describe(const sobb_ray& ray) {
  char text[256];
  std::snprintf(text, sizeof text, "ray o %a %a %a d %a %a %a t %a %a", ray.origin[0],
                ray.origin[1], ray.origin[2], ray.direction[0], ray.direction[1], ray.direction[2],
                ray.tmin, ray.tmax);
  return text;
}

void expect_same(const std::vector<sobb_hit>& hits, const std::vector<sobb_hit>& expected,
                 const std::vector<sobb_ray>& rays, const std::string& what) {
  int shown = 0;
  for (size_t i = 0; i < hits.size() && shown < 3; ++i) {
    if (std::memcmp(&hits[i], &expected[i], sizeof hits[i]) == 0) continue;
    ++shown;
    ADD_FAILURE() << what << ": ray " << i << " hits " << hits[i].primitive << " at " << hits[i].t
                  << ", not " << expected[i].primitive << " at " << expected[i].t << "; "
                  << describe(rays[i]);
  }
}

void expect_same(const std::vector<uint8_t>& occluded, const std::vector<sobb_hit>& expected,
                 const std::vector<sobb_ray>& rays, const std::string& what) {
  int shown = 0;
  for (size_t i = 0; i < occluded.size() && shown < 3; ++i) {
    const uint8_t right = expected[i].primitive == SOBB_INVALID ? SOBB_OCCLUDED_INVALID
                          : expected[i].primitive == SOBB_MISS  ? SOBB_FREE
                                                                : SOBB_OCCLUDED;
    if (occluded[i] == right) continue;
    ++shown;
    ADD_FAILURE() << what << ": ray " << i << " occluded " << int{occluded[i]} << ", not "
                  << int{right} << "; " << describe(rays[i]);
  }
}

// All calls of one hierarchy.
void check_calls(const sobb_hierarchy* hierarchy, const std::vector<sobb_ray>& rays,
                 const std::vector<sobb_hit>& expected, const std::string& what) {
  std::vector<sobb_hit> hits(rays.size());
  std::vector<uint8_t> occluded(rays.size());
  for (const uint32_t isa : {SOBB_ISA_SSE4, SOBB_ISA_AVX2}) {
    sobb_isa resolved;
    if (sobb_resolve_isa(static_cast<sobb_isa>(isa), &resolved) != SOBB_OK) continue;
    for (const uint32_t flags : {0U, static_cast<uint32_t>(SOBB_TRACE_COHERENT)}) {
      const std::string call =
          what + " isa " + std::to_string(isa) + " flags " + std::to_string(flags);
      const sobb_trace_options options = {sizeof options, flags, 1, isa, nullptr, nullptr, nullptr};
      ASSERT_EQ(sobb_intersect(hierarchy, rays.data(), rays.size(), hits.data(), &options),
                SOBB_OK);
      expect_same(hits, expected, rays, call);
      ASSERT_EQ(sobb_occluded(hierarchy, rays.data(), rays.size(), occluded.data(), &options),
                SOBB_OK);
      expect_same(occluded, expected, rays, call);
    }
  }
  for (size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(sobb_intersect1(hierarchy, &rays[i], &hits[i]), SOBB_OK);
    ASSERT_EQ(sobb_occluded1(hierarchy, &rays[i], &occluded[i]), SOBB_OK);
  }
  expect_same(hits, expected, rays, what + " single");
  expect_same(occluded, expected, rays, what + " single");
}

class EveryWay : public testing::TestWithParam<Soup> {};

TEST_P(EveryWay, ReturnsTheOraclesBits) {
  const Soup& soup = GetParam();
  const uint64_t seed = 20251;
  const std::vector<sobb_ray> rays = mixed_rays(soup, seed, 3000);
  const std::vector<sobb_hit> expected = oracle(soup, rays);
  RecordProperty("seed", std::to_string(seed));
  for (const uint32_t quality : {SOBB_QUALITY_LOW, SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH}) {
    for (const uint32_t width : {4U, 8U}) {
      for (const uint32_t k : {0U, 32U, 48U, 64U}) {
        sobb_build_options options = {};
        options.struct_size = sizeof options;
        options.volume = k == 0 ? SOBB_VOLUME_AABB : SOBB_VOLUME_SOBB;
        options.k = k;
        options.quality = quality;
        options.width = width;
        options.strategy = 1 + (k / 16 + width / 4 + quality) % 3;
        const Handle hierarchy = build(soup, options);
        ASSERT_TRUE(hierarchy);
        check_calls(hierarchy.get(), rays, expected,
                    soup.name + " seed " + std::to_string(seed) + " quality " +
                        std::to_string(quality) + " width " + std::to_string(width) + " k " +
                        std::to_string(k));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Soups, EveryWay,
    testing::Values(random_soup(1, 2000), random_soup(2, 1), random_soup(3, 5),
                    sliver_soup(4, 1000), closed_box(12), degenerate_soup(5, 800),
                    identical_soup(300), placed(random_soup(6, 500), 1e-6, 0),
                    placed(random_soup(7, 500), 1e12, 0), placed(random_soup(8, 500), 1, 1000),
                    placed(sliver_soup(9, 500), 1e-3, 7), placed(random_soup(10, 500), 1e-22, 0),
                    placed(random_soup(11, 300), 0x1p59, 0)),
    [](const testing::TestParamInfo<Soup>& info) { return "soup" + std::to_string(info.index); });

}  // namespace
}  // namespace sobb::test
