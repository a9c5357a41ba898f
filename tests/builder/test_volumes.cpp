// SPDX-License-Identifier: Apache-2.0
// In a built file every point of every triangle lies in all volumes on the way from the root to a
// leaf that holds the triangle, in (near) exact arithmetic. The reader accepts the file.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory_resource>
#include <string>
#include <utility>
#include <vector>

#include "builder/build.h"
#include "builder/sampled_triangle.h"
#include "builder/volumes/leaf_kdop.h"
#include "format/reader/reader.h"
#include "support/soups.h"

namespace sobb::test {
namespace {

sobb_build_options options_of(uint32_t k, uint32_t quality, uint32_t width) {
  sobb_build_options options = {};
  options.volume = k == 0 ? SOBB_VOLUME_AABB : SOBB_VOLUME_SOBB;
  options.k = k;
  options.quality = quality;
  options.width = width;
  return options;
}

Built build_soup(const Soup& soup, const sobb_build_options& options) {
  Progress progress(nullptr, nullptr);
  return build(soup.view(), BuildSettings(options), Scheduler(1, nullptr),
               std::make_shared<Memory>(), progress);
}

// A slab that computes n . (p - c) in 64 bits: for floats n and c products have 24 and some 30
// bits.
struct Slab {
  Direction normal;
  float lower, upper;

  bool holds(const long double at[3]) const {
    const long double along = normal.x * at[0] + normal.y * at[1] + normal.z * at[2];
    return lower <= along && along <= upper;
  }
};

// Walks down with the slabs of all ancestors, and removes the samples that a leaf holds.
template <int W>
class Walker {
 public:
  Walker(const FileView& view, const Mesh& mesh) : view_(view), mesh_(mesh) {
    left_.resize(mesh.triangle_count());
    for (uint64_t t = 0; t < left_.size(); ++t) {
      left_[t] = sample_triangle(Corners(mesh, t));
      for (Sample& sample : left_[t]) {
        for (int k = 0; k < 3; ++k) sample.at[k] -= view.header->centre[k];
      }
    }
    references_.resize(mesh.triangle_count());
  }

  void walk(uint32_t index = 0) {
    const Node<W>& node = view_.nodes_of<W>()[index];
    for (uint32_t i = 0; i < child_count(node); ++i) {
      for (int j = 0; j < 3; ++j) {
        slabs_.push_back({view_.directions[basis_direction(node.basis[i], j)], node.slab[j][0][i],
                          node.slab[j][1][i]});
      }
      if ((node.meta[i] & kLeafBit) != 0) {
        visit_leaf(node.reference[i], node.meta[i] & kTriangleMask);
      } else {
        walk(node.reference[i]);
      }
      slabs_.resize(slabs_.size() - 3);
    }
  }

  void expect_complete(bool split) const {
    for (uint64_t t = 0; t < left_.size(); ++t) {
      ASSERT_GE(references_[t], 1u) << "triangle " << t << " is in no leaf";
      ASSERT_TRUE(split || references_[t] == 1) << "triangle " << t;
      ASSERT_TRUE(left_[t].empty())
          << left_[t].size() << " points of triangle " << t << " lie in no leaf that holds it";
    }
  }

 private:
  void visit_leaf(uint32_t block, uint32_t count) {
    for (uint32_t n = 0; n < count; ++n) {
      const TriangleBlock& triangles = view_.blocks[block + n / 4];
      const uint32_t primitive = triangles.primitive[n % 4];
      ASSERT_LT(primitive, references_.size());
      ++references_[primitive];
      const Corners corners(mesh_, primitive);
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
          ASSERT_EQ(triangles.vertex[i][k][n % 4], corners.at[i][k]);
        }
      }
      std::erase_if(left_[primitive], [&](const Sample& sample) {
        return std::all_of(slabs_.begin(), slabs_.end(),
                           [&](const Slab& slab) { return slab.holds(sample.at); });
      });
    }
  }

  const FileView& view_;
  const Mesh& mesh_;
  std::vector<Slab> slabs_;
  std::vector<std::vector<Sample>> left_;
  std::vector<uint32_t> references_;
};

template <int W>
void check(const FileView& view, const Mesh& mesh, bool split) {
  Walker<W> walker(view, mesh);
  walker.walk();
  walker.expect_complete(split);
}

class Volumes : public testing::TestWithParam<Soup> {};

TEST_P(Volumes, HoldTheTrianglesBelow) {
  const Soup& soup = GetParam();
  const Scheduler serial(1, nullptr);
  Progress progress(nullptr, nullptr);
  const Mesh mesh(soup.view(), serial);
  for (const uint32_t quality : {SOBB_QUALITY_LOW, SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH}) {
    for (const uint32_t width : {4, 8}) {
      for (const uint32_t k : {0, 32, 48, 64}) {
        SCOPED_TRACE(soup.name + " quality " + std::to_string(quality) + " width " +
                     std::to_string(width) + " k " + std::to_string(k));
        const Built built = build_soup(soup, options_of(k, quality, width));
        ASSERT_NO_THROW(read_image(built.image.bytes(), "built", serial,
                                   *std::pmr::get_default_resource(), progress));
        const bool split = quality == SOBB_QUALITY_HIGH;
        width == 4 ? check<4>(built.view, mesh, split) : check<8>(built.view, mesh, split);
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST_P(Volumes, HoldTheTrianglesBelowInAFittedFrame) {
  const Soup& soup = GetParam();
  const Scheduler serial(1, nullptr);
  Progress progress(nullptr, nullptr);
  const Mesh mesh(soup.view(), serial);
  for (const uint32_t quality : {SOBB_QUALITY_LOW, SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH}) {
    SCOPED_TRACE(soup.name + " quality " + std::to_string(quality));
    sobb_build_options options = options_of(64, quality, 8);
    options.table = SOBB_TABLE_FITTED;
    const Built built = build_soup(soup, options);
    ASSERT_NO_THROW(read_image(built.image.bytes(), "built", serial,
                               *std::pmr::get_default_resource(), progress));
    check<8>(built.view, mesh, quality == SOBB_QUALITY_HIGH);
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Soups, Volumes,
    testing::Values(random_soup(1, 500), random_soup(2, 200, 1.5), random_soup(3, 1),
                    sliver_soup(4, 400), placed(sliver_soup(5, 200), 1, 1e4),
                    placed(random_soup(6, 200), 1, 1e6), placed(random_soup(7, 200, 1), 0x1p58, 0),
                    placed(sliver_soup(8, 200), 1e-6, 0), placed(random_soup(9, 200), 1e-38, 0),
                    placed(random_soup(10, 200), 1e-44, 0), degenerate_soup(11, 200), closed_box(4),
                    identical_soup(60), turned_boxes(12, 60), placed(turned_boxes(13, 40), 1, 1e5),
                    placed(turned_boxes(14, 40), 0x1p58, 0),
                    placed(turned_boxes(15, 40), 1e-40, 0)),
    [](const testing::TestParamInfo<Soup>& info) { return "soup" + std::to_string(info.index); });

// Spatial splits bound a triangle's parts by one box after the other, so a box may be left that the
// triangle misses. A leaf of nothing else still needs a volume that a reader accepts.
TEST(Leaf, HasAVolumeWhereAllTrianglesMissTheirBoxes) {
  const Soup soup{"triangle", {0, 0, 0, 1, 0, 1, 0, 1, 1}, {0, 1, 2}};  // z = x + y
  const Mesh mesh(soup.view(), Scheduler(1, nullptr));
  const uint32_t primitive = 0;
  const Box box = {{0.3F, 0.5F, 0.5F}, {0.5F, 0.7F, 0.7F}};
  const DirectionTable directions = make_direction_table(default_directions(64));
  const float centre[3] = {0.5F, 0.5F, 0.5F};
  Kdop kdop;
  fit_leaf(mesh, {{&primitive, 1}, {&box, 1}}, directions, centre, bounds_kernels(SOBB_ISA_SSE4),
           kdop);
  for (uint32_t k = 0; k < directions.count; ++k) {
    EXPECT_LE(kdop.lower[k], kdop.upper[k]);
    EXPECT_LT(std::max(-kdop.lower[k], kdop.upper[k]), 1);
  }
}

}  // namespace
}  // namespace sobb::test
