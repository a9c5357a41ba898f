// SPDX-License-Identifier: Apache-2.0
// Cells hold all triangles once, in the order they had, and are the same for any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "base/memory.h"
#include "builder/boxes/box.h"
#include "builder/mesh.h"
#include "builder/topology/morton_cells.h"
#include "support/soups.h"

namespace sobb::test {
namespace {

struct Sorted {
  Soup soup;
  Memory memory;
  Scheduler scheduler;
  Mesh mesh;
  std::vector<uint32_t> triangles;
  MortonCells cells;

  Sorted(Soup of, uint32_t threads)
      : soup(std::move(of)),
        scheduler(threads, nullptr),
        mesh(soup.view(), scheduler),
        triangles(all(mesh)),
        cells(sort_into_cells(mesh, Frame(), triangles, scheduler, memory)) {}

  static std::vector<uint32_t> all(const Mesh& mesh) {
    std::vector<uint32_t> triangles(mesh.triangle_count());
    std::iota(triangles.begin(), triangles.end(), 0);
    return triangles;
  }
  // The box of the centres of the cells from `first` to `last` - 1.
  Box centres(uint64_t first, uint64_t last) const {
    Box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (uint64_t i = cells.begin[first]; i < cells.begin[last]; ++i) {
      const Box one = box_of(mesh, triangles[i], Frame());
      float centre[3];
      for (int k = 0; k < 3; ++k) centre[k] = one.lower[k] + one.upper[k];
      box.grow({{centre[0], centre[1], centre[2]}, {centre[0], centre[1], centre[2]}});
    }
    return box;
  }
};

TEST(MortonCells, HoldEveryTriangleOnceInItsOrder) {
  for (const Soup& soup : {random_soup(1, 20'000), sliver_soup(2, 3'000), degenerate_soup(3, 500),
                           identical_soup(1000), random_soup(4, 1)}) {
    SCOPED_TRACE(soup.name);
    const Sorted sorted(soup, 1);
    ASSERT_EQ(sorted.cells.triangle_count(), sorted.mesh.triangle_count());
    for (uint64_t cell = 0; cell < sorted.cells.count(); ++cell) {
      EXPECT_TRUE(std::is_sorted(sorted.triangles.begin() + sorted.cells.begin[cell],
                                 sorted.triangles.begin() + sorted.cells.begin[cell + 1]));
    }
    std::vector<uint32_t> found = sorted.triangles;
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, Sorted::all(sorted.mesh));
  }
}

// Cells are in Morton order: the highest bit of their numbers halves the grid across one axis, the
// next bit across another.
TEST(MortonCells, HalvesLieOnEitherSideOfAPlane) {
  const Sorted sorted(random_soup(5, 60'000, 0.01), 1);
  const uint64_t count = sorted.cells.count();
  for (const int axis : {2, 1, 0}) {
    const uint64_t part = count >> (3 - axis);
    for (uint64_t first = 0; first < count; first += 2 * part) {
      const Box left = sorted.centres(first, first + part);
      const Box right = sorted.centres(first + part, first + 2 * part);
      EXPECT_LE(left.upper[axis], right.lower[axis]) << "axis " << axis << ", cell " << first;
    }
  }
}

TEST(MortonCells, AreTheSameForAnyThreadCount) {
  const Soup soup = random_soup(6, 50'000);
  const Sorted one(soup, 1);
  const Sorted three(soup, 3);
  EXPECT_EQ(one.triangles, three.triangles);
  EXPECT_TRUE(std::ranges::equal(one.cells.begin, three.cells.begin));
}

TEST(MortonCells, TrianglesOfOnePlaceAreInOne) {
  EXPECT_TRUE(Sorted(identical_soup(1000), 1).cells.is_one());
  EXPECT_TRUE(Sorted(random_soup(7, 1), 1).cells.is_one());
  EXPECT_FALSE(Sorted(random_soup(7, 2), 1).cells.is_one());
}

}  // namespace
}  // namespace sobb::test
