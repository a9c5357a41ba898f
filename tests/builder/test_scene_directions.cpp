// SPDX-License-Identifier: Apache-2.0
// A table fitted to a mesh begins with the frame of scenes built at right angles, and is the
// default set for others. It is unit and perpendicular, and the same for any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <string>
#include <vector>

#include "bounds/area.h"
#include "bounds/directions/direction_table.h"
#include "builder/scene_directions.h"
#include "support/more_threads.h"
#include "support/soups.h"

namespace sobb::test {
namespace {

std::pmr::vector<Direction> directions_of(const Soup& soup, uint32_t k = 64, uint32_t threads = 1) {
  const Scheduler scheduler(threads, nullptr);
  DirectionSet found = scene_directions(Mesh(soup.view(), scheduler), k, scheduler,
                                        *std::pmr::get_default_resource());
  EXPECT_EQ(found.table, table_of_file(found.directions)) << soup.name;
  return std::move(found.directions);
}

bool same(std::span<const Direction> a, std::span<const Direction> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Direction& m, const Direction& n) {
                      return m.x == n.x && m.y == n.y && m.z == n.z;
                    });
}

double cosine(const Direction& a, const Vector& b) { return a.x * b[0] + a.y * b[1] + a.z * b[2]; }

TEST(SceneDirections, FindTheFrameOfTurnedBoxes) {
  for (const uint32_t k : {32, 48, 64}) {
    const auto found = directions_of(turned_boxes(1, 300), k);
    ASSERT_EQ(found.size(), k / 2);
    for (const Vector& axis :
         {Vector{2 / 3.0, -1 / 3.0, 2 / 3.0}, Vector{2 / 3.0, 2 / 3.0, -1 / 3.0},
          Vector{-1 / 3.0, 2 / 3.0, 2 / 3.0}}) {
      const auto is_axis = [&](const Direction& n) {
        return std::fabs(std::fabs(cosine(n, axis)) - 1) < 1e-6;
      };
      EXPECT_EQ(std::count_if(found.begin(), found.begin() + 3, is_axis), 1);
    }
  }
}

TEST(SceneDirections, AreTheDefaultOnesWithoutABetterFrame) {
  for (const Soup& soup : {closed_box(8), identical_soup(1)}) {
    EXPECT_TRUE(same(directions_of(soup), default_directions(64))) << soup.name;
  }
}

TEST(SceneDirections, AreUnitAndBeginPerpendicular) {
  Soup line{"line", {0, 0, 0, 1, 2, 3, 2, 4, 6}, {0, 1, 2}};
  Soup point{"point", {1, 1, 1}, {0, 0, 0}};
  Soup one{"one", {0, 0, 0, 1, 2, 3, -2, 1, 0}, {0, 1, 2}};
  Soup flat{"flat", {}, {}};
  Random random(3);
  for (int i = 0; i < 100; ++i) {  // in the plane x + 2 y + 3 z = 0
    float corner[3][3];
    for (auto& c : corner) {
      c[0] = random.between(-1, 1);
      c[1] = random.between(-1, 1);
      c[2] = -(c[0] + 2 * c[1]) / 3;
    }
    flat.add(corner[0], corner[1], corner[2]);
  }
  for (const Soup& soup :
       {line, point, one, flat, degenerate_soup(4, 300), sliver_soup(5, 500), turned_boxes(6, 100),
        placed(turned_boxes(7, 100), 0x1p59, 0), placed(turned_boxes(8, 100), 1e-30, 0),
        placed(turned_boxes(9, 100), 1e-44, 0), placed(turned_boxes(10, 100), 1, 1e6)}) {
    const auto found = directions_of(soup);
    ASSERT_EQ(found.size(), 32u);
    for (const Direction& n : found) EXPECT_NEAR(dot(n, n), 1, 4e-7) << soup.name;
    for (size_t i = 0; i < 3; ++i) {
      for (size_t j = 0; j < i; ++j) EXPECT_NEAR(dot(found[i], found[j]), 0, 2e-7) << soup.name;
    }
  }
}

TEST(SceneDirections, AreTheSameForAnyThreadCount) {
  const MoreThreads more(8);
  for (const Soup& soup : {turned_boxes(11, 14'000), sliver_soup(12, 40'000)}) {
    const auto one = directions_of(soup);
    for (const uint32_t threads : {2, 3, 8}) {
      EXPECT_TRUE(same(directions_of(soup, 64, threads), one)) << soup.name << threads;
    }
  }
}

}  // namespace
}  // namespace sobb::test
