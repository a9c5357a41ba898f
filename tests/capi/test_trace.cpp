// SPDX-License-Identifier: Apache-2.0
// Every way to trace returns the oracle's bits: volumes, k, widths, qualities, strategies,
// instruction sets, calls.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "capi/every_call.h"
#include "capi/random_bases.h"

namespace sobb::test {
namespace {

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
        const HierarchyHandle hierarchy = build_soup(soup, options);
        ASSERT_TRUE(hierarchy);
        const std::string what = soup.name + " seed " + std::to_string(seed) + " quality " +
                                 std::to_string(quality) + " width " + std::to_string(width) +
                                 " k " + std::to_string(k);
        check_calls(hierarchy, rays, expected, what);
        if (k == 0) continue;
        check_calls(with_random_bases(hierarchy, seed), rays, expected, what + " random bases");
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
