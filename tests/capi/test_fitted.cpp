// SPDX-License-Identifier: Apache-2.0
// Fitted tables through the C ABI: the oracle's bits, the same bytes however the build is run, and
// what the options and the information say.
#include <gtest/gtest.h>

#include <cstddef>

#include "capi/handles.h"
#include "support/more_threads.h"
#include "support/supported_isas.h"

namespace sobb::test {
namespace {

constexpr uint32_t kQualities[] = {SOBB_QUALITY_LOW, SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH};

sobb_build_options fitted_options(uint32_t quality = 0, uint32_t width = 0, uint32_t k = 0) {
  sobb_build_options options = build_options(SOBB_VOLUME_SOBB, quality, 1);
  options.table = SOBB_TABLE_FITTED;
  options.width = width;
  options.k = k;
  return options;
}

sobb_build_options spread_options() {
  sobb_build_options options = build_options(SOBB_VOLUME_SOBB, 0, 1);
  options.table = SOBB_TABLE_SPREAD;
  return options;
}

class Fitted : public testing::TestWithParam<Soup> {};

TEST_P(Fitted, ReturnsTheOraclesBits) {
  const Soup& soup = GetParam();
  constexpr uint64_t kSeed = 31;
  const std::vector<sobb_ray> rays = mixed_rays(soup, kSeed, 3000);
  const sobb_triangles triangles = soup.view();
  std::vector<sobb_hit> expected(rays.size());
  ASSERT_EQ(sobb_brute_force(&triangles, rays.data(), rays.size(), expected.data(), nullptr),
            SOBB_OK);
  for (const uint32_t quality : kQualities) {
    for (const uint32_t width : {4U, 8U}) {
      for (const uint32_t k : {32U, 48U, 64U}) {
        const HierarchyHandle hierarchy = build_soup(soup, fitted_options(quality, width, k));
        for (const uint32_t flags : {0U, static_cast<uint32_t>(SOBB_TRACE_COHERENT)}) {
          EXPECT_TRUE(same(trace(hierarchy, rays, trace_options(flags)), expected))
              << soup.name << " seed " << kSeed << " quality " << quality << " width " << width
              << " k " << k << " flags " << flags;
        }
      }
    }
  }
}

TEST_P(Fitted, GivesTheSameBytesForAnyThreadsAndInstructionSet) {
  const MoreThreads more(8);
  for (const uint32_t quality : kQualities) {
    sobb_build_options options = fitted_options(quality);
    options.isa = SOBB_ISA_SSE4;
    const std::string expected = bytes_of(build_soup(GetParam(), options));
    for (const sobb_isa isa : supported_isas()) {
      options.isa = isa;
      EXPECT_TRUE(bytes_of(build_soup(GetParam(), options)) == expected) << sobb_isa_title(isa);
    }
    options.isa = SOBB_ISA_BEST;
    for (const uint32_t threads : {1, 3, 8}) {
      options.threads = threads;
      EXPECT_TRUE(bytes_of(build_soup(GetParam(), options)) == expected) << threads << " threads";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Soups, Fitted,
    testing::Values(turned_boxes(1, 100), random_soup(2, 500), sliver_soup(3, 500),
                    degenerate_soup(4, 300), placed(turned_boxes(5, 50), 1, 1e4),
                    placed(turned_boxes(6, 50), 0x1p58, 0), placed(turned_boxes(7, 50), 1e-30, 0)),
    [](const testing::TestParamInfo<Soup>& info) { return "soup" + std::to_string(info.index); });

TEST(FittedOptions, SayWhatTheTableIs) {
  const Soup boxes = turned_boxes(8, 100);
  const HierarchyHandle spread = build_soup(boxes, spread_options());
  EXPECT_EQ(info_of(spread).table, static_cast<uint32_t>(SOBB_TABLE_SPREAD));
  const HierarchyHandle fitted = build_soup(boxes, fitted_options());
  EXPECT_EQ(info_of(fitted).table, static_cast<uint32_t>(SOBB_TABLE_FITTED));
  EXPECT_LT(info_of(fitted).leaf_area, 0.7 * info_of(spread).leaf_area);
  EXPECT_TRUE(bytes_of(build_soup(boxes)) == bytes_of(fitted)) << "the default";
  const std::string bytes = bytes_of(fitted);
  sobb_hierarchy* opened = nullptr;
  ASSERT_EQ(sobb_open_memory(bytes.data(), bytes.size(), nullptr, &opened), SOBB_OK);
  EXPECT_EQ(info_of(HierarchyHandle(opened)).table, static_cast<uint32_t>(SOBB_TABLE_FITTED));
  EXPECT_EQ(info_of(build_soup(boxes, build_options(SOBB_VOLUME_AABB))).table,
            static_cast<uint32_t>(SOBB_TABLE_SPREAD));
  // Where nothing is better than the axes, the table is the spread one, to the byte.
  const Soup straight = closed_box(4);
  EXPECT_TRUE(bytes_of(build_soup(straight, fitted_options())) ==
              bytes_of(build_soup(straight, spread_options())));
}

TEST(FittedOptions, AreCheckedAndMayBeMissing) {
  const Soup boxes = turned_boxes(9, 20);
  const sobb_triangles triangles = boxes.view();
  sobb_hierarchy* out = nullptr;
  sobb_build_options options = fitted_options();
  options.volume = SOBB_VOLUME_AABB;
  EXPECT_EQ(sobb_build(&triangles, &options, &out), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(sobb_last_error(),
               "build options: a fitted table is for SOBBs, and the volume is the AABB");
  options = fitted_options();
  options.table = 3;
  EXPECT_EQ(sobb_build(&triangles, &options, &out), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(sobb_last_error(), "build options: table is 3");
  options = fitted_options();
  options.reserved = 1;
  EXPECT_EQ(sobb_build(&triangles, &options, &out), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(sobb_last_error(), "build options: reserved is 1");
  // A program from before there were tables.
  options.struct_size = offsetof(sobb_build_options, table);
  EXPECT_EQ(info_of(build_soup(boxes, options)).table, static_cast<uint32_t>(SOBB_TABLE_FITTED));
}

}  // namespace
}  // namespace sobb::test
