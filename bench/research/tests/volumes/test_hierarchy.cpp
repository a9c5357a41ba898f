// SPDX-License-Identifier: Apache-2.0
// Hierarchies of every volume are conservative, find the oracle's bits, and are the same from every
// instruction set and number of threads.
#include <gtest/gtest.h>

#include <cstring>

#include "base/error.h"
#include "builder/build.h"
#include "support/soups.h"
#include "support/supported_isas.h"
#include "volumes/hierarchy.h"

namespace sobb::study {
namespace {

using test::Soup;

std::vector<Soup> soups() {
  return {test::random_soup(1, 3000),
          test::random_soup(2, 7),
          test::sliver_soup(3, 2000),
          test::closed_box(12),
          test::degenerate_soup(4, 500),
          test::identical_soup(40),
          test::placed(test::random_soup(5, 1000), 1e-6, 0),
          test::placed(test::sliver_soup(6, 1000), 1e6, 3e7),
          test::placed(test::random_soup(7, 1000), 1, 1000)};
}

class EveryVolume : public testing::TestWithParam<Method> {
 protected:
  const Scheduler serial_{1, nullptr};
  const Scheduler parallel_{0, nullptr};

  SharedTopology share(const Soup& soup) const {
    return SharedTopology(soup.view(), serial_, std::make_shared<Memory>());
  }
};

TEST_P(EveryVolume, HitsAreTheOraclesAndNoVertexLeaks) {
  for (const Soup& soup : soups()) {
    const sobb_triangles triangles = soup.view();
    const std::vector<sobb_ray> rays = test::mixed_rays(soup, 11, 300);
    std::vector<sobb_hit> right(rays.size());
    ASSERT_EQ(sobb_brute_force(&triangles, rays.data(), rays.size(), right.data(), nullptr),
              SOBB_OK);
    const SharedTopology topology = share(soup);
    for (const uint32_t width : {2U, 8U}) {
      for (const sobb_isa isa : test::supported_isas()) {
        SCOPED_TRACE(soup.name + ", width " + std::to_string(width) + ", isa " +
                     std::to_string(isa));
        const Hierarchy hierarchy(topology, {GetParam(), width, SOBB_STRATEGY_K2, isa}, serial_);
        EXPECT_EQ(hierarchy.count_leaks(), 0U);
        std::vector<sobb_hit> hits(rays.size());
        hierarchy.intersect(rays.data(), rays.size(), hits.data(), nullptr, serial_);
        for (size_t i = 0; i < rays.size(); ++i) {
          ASSERT_EQ(std::memcmp(&hits[i], &right[i], sizeof(sobb_hit)), 0)
              << "ray " << i << " hits " << hits[i].primitive << " at " << hits[i].t << ", not "
              << right[i].primitive << " at " << right[i].t;
        }
      }
    }
  }
}

TEST_P(EveryVolume, AreasAndWorkDoNotDependOnTheWay) {
  const Soup soup = test::random_soup(21, 20000, 0.05);
  const SharedTopology topology = share(soup);
  const std::vector<sobb_ray> rays = test::mixed_rays(soup, 22, 500);
  for (const uint32_t width : {2U, 8U}) {
    const Hierarchy first(topology, {GetParam(), width, SOBB_STRATEGY_K2, SOBB_ISA_SSE4}, serial_);
    std::vector<sobb_hit> hits(rays.size());
    std::vector<sobb_count> counts(rays.size());
    first.intersect(rays.data(), rays.size(), hits.data(), counts.data(), serial_);
    for (const sobb_isa isa : test::supported_isas()) {
      const Hierarchy other(topology, {GetParam(), width, SOBB_STRATEGY_K2, isa}, parallel_);
      EXPECT_EQ(other.areas(parallel_).inner, first.areas(serial_).inner);
      EXPECT_EQ(other.areas(parallel_).leaf, first.areas(serial_).leaf);
      EXPECT_EQ(other.node_bytes(), first.node_bytes());
      std::vector<sobb_hit> other_hits(rays.size());
      other.intersect(rays.data(), rays.size(), other_hits.data(), nullptr, parallel_);
      EXPECT_EQ(std::memcmp(hits.data(), other_hits.data(), hits.size() * sizeof(sobb_hit)), 0);
    }
  }
}

std::string test_name(const testing::TestParamInfo<Method>& info) {
  std::string name(info.param.name);
  std::erase_if(name, [](char c) { return c == ' ' || c == '-'; });
  return name;
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryVolume, testing::ValuesIn(kMethods), test_name);

const Method& method(std::string_view name) {
  for (const Method& one : kMethods) {
    if (one.name == name) return one;
  }
  throw std::invalid_argument(std::string(name));
}

// The AABBs here are those of a file: they have the same topology and the same areas.
TEST(VolumeAreas, OfAabbsAreThoseOfAFile) {
  const Soup soup = test::random_soup(31, 5000);
  const sobb_triangles triangles = soup.view();
  sobb_build_options options = SOBB_BUILD_OPTIONS_INIT;
  options.volume = SOBB_VOLUME_AABB;
  sobb_hierarchy* built = nullptr;
  ASSERT_EQ(sobb_build(&triangles, &options, &built), SOBB_OK);
  sobb_info info = SOBB_INFO_INIT;
  ASSERT_EQ(sobb_get_info(built, &info), SOBB_OK);
  sobb_release(built);

  const Scheduler serial(1, nullptr);
  const SharedTopology topology(triangles, serial, std::make_shared<Memory>());
  const Hierarchy hierarchy(topology, {method("AABB"), 8}, serial);
  const Areas areas = hierarchy.areas(serial);
  EXPECT_NEAR(areas.inner, info.inner_area, 1e-9 * info.inner_area);
  EXPECT_NEAR(areas.leaf, info.leaf_area, 1e-9 * info.leaf_area);
  EXPECT_EQ(topology.node_count(8), info.nodes);
  EXPECT_EQ(topology.leaf_count(), info.leaves);
}

// More directions, and more triples of them tried, bound closer. Every oriented or skewed volume
// bounds slivers closer than boxes along the axes.
TEST(VolumeAreas, FallWithEffort) {
  const Soup soup = test::sliver_soup(41, 4000);
  const Scheduler serial(1, nullptr);
  const SharedTopology topology(soup.view(), serial, std::make_shared<Memory>());
  const auto leaf_area = [&](std::string_view name, sobb_strategy strategy) {
    return Hierarchy(topology, {method(name), 2, strategy}, serial).areas(serial).leaf;
  };
  const double aabb = leaf_area("AABB", SOBB_STRATEGY_K2);
  EXPECT_LT(leaf_area("14-DOP", SOBB_STRATEGY_K2), aabb);
  EXPECT_LT(leaf_area("OBB", SOBB_STRATEGY_K2), aabb);
  EXPECT_LE(leaf_area("SOBB 64i", SOBB_STRATEGY_K2), leaf_area("SOBB 64i", SOBB_STRATEGY_K));
  EXPECT_LE(leaf_area("SOBB 64i", SOBB_STRATEGY_K3), leaf_area("SOBB 64i", SOBB_STRATEGY_K2));
  EXPECT_LT(leaf_area("SOBB 256", SOBB_STRATEGY_K3), leaf_area("SOBB 32d", SOBB_STRATEGY_K3));
  // The two forms bound the same; the direct one is wider by its rounding.
  EXPECT_NEAR(leaf_area("SOBB 48d", SOBB_STRATEGY_K2) / leaf_area("SOBB 48i", SOBB_STRATEGY_K2), 1,
              0.05);
}

TEST(VolumeErrors, AWidthThatIsNone) {
  const Soup soup = test::random_soup(51, 10);
  const Scheduler serial(1, nullptr);
  const SharedTopology topology(soup.view(), serial, std::make_shared<Memory>());
  EXPECT_THROW(Hierarchy(topology, {method("AABB"), 4}, serial), Error);
}

TEST(VolumeErrors, AScaleWithoutRoom) {
  const Soup soup = test::placed(test::random_soup(52, 10), 0x1p50, 0);
  const Scheduler serial(1, nullptr);
  const SharedTopology topology(soup.view(), serial, std::make_shared<Memory>());
  EXPECT_THROW(Hierarchy(topology, {method("OBB"), 2}, serial), Error);
}

}  // namespace
}  // namespace sobb::study
