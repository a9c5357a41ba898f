// SPDX-License-Identifier: Apache-2.0
// The counting traversal hits what brute force hits, in every tree and however it clips.
#include "study/bases/counting_trace.h"

#include <gtest/gtest.h>

#include "base/memory.h"
#include "study/bases/basis_rules.h"
#include "support/soups.h"

namespace sobb::study {
namespace {

constexpr BasisRule kRules[] = {{BasisFrom::kEachChild, SOBB_STRATEGY_K3, false},
                                {BasisFrom::kAxes, SOBB_STRATEGY_K2, false},
                                {BasisFrom::kAverageExtents, SOBB_STRATEGY_K2, true},
                                {BasisFrom::kSumOfAreas, SOBB_STRATEGY_K, false},
                                {BasisFrom::kSumOrAxes, SOBB_STRATEGY_K3, true}};

class CountingTrace : public testing::TestWithParam<uint32_t> {};  // the width

TEST_P(CountingTrace, HitsWhatBruteForceHits) {
  const test::Soup soup = test::random_soup(11, 400);
  const sobb_triangles triangles = soup.view();
  const std::vector<sobb_ray> rays = test::mixed_rays(soup, 12, 500);
  std::vector<sobb_hit> expected(rays.size());
  ASSERT_EQ(sobb_brute_force(&triangles, rays.data(), rays.size(), expected.data(), nullptr),
            SOBB_OK);
  uint64_t hits = 0;
  double distance = 0;
  for (const sobb_hit& hit : expected) {
    if (hit.primitive == SOBB_MISS) continue;
    ++hits;
    distance += hit.t;
  }
  ASSERT_GT(hits, 0U);

  const Scheduler scheduler(1, nullptr);
  Memory memory;
  Progress progress(nullptr, nullptr);
  const Mesh mesh(triangles, scheduler);
  const MeshSummary summary = summarise(mesh, scheduler, memory);
  const Topology topology(mesh, SOBB_QUALITY_MEDIUM, scheduler, memory, progress, 1);
  const Tree tree = make_tree(topology, GetParam(), scheduler, memory);
  const auto directions = default_directions(64);
  const DirectionTable table = make_direction_table(directions);
  const float centre[3] = {summary.centre.x, summary.centre.y, summary.centre.z};
  const auto kdops = fit_children(tree, mesh, centre, table, scheduler);
  const BasisChooser chooser(directions, tree, kdops, summary.radius, scheduler, memory);
  for (const BasisRule& rule : kRules) {
    SCOPED_TRACE(rule.name());
    const auto bases = chooser.choose(rule);
    const BoundedTree bounded = {tree, kdops, bases, table, summary, mesh};
    const Work loose = count_work(bounded, rays, Clip::kRay, scheduler);
    const Work clipped = count_work(bounded, rays, Clip::kParent, scheduler);
    EXPECT_EQ(loose.hits, hits);
    EXPECT_NEAR(loose.distance, distance, 1e-9 * distance);
    EXPECT_TRUE(clipped.same_hits(loose));
    EXPECT_LE(clipped.nodes, loose.nodes);
  }
}

INSTANTIATE_TEST_SUITE_P(Widths, CountingTrace, testing::Values(2, 4, 8),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace sobb::study
