// SPDX-License-Identifier: Apache-2.0
// What does a basis shared by a node's children lose against one for each child, by the way it is
// chosen? The answer counts sums of areas, and the volumes and triangles that a secondary ray
// tests.
#include "study/bases/fitted_tree.h"
#include "study/study_scene.h"

namespace sobb::study {
namespace {

constexpr uint32_t kPlanes = 64;
constexpr uint32_t kWidths[] = {4, 8};

constexpr BasisRule kRules[] = {
    {BasisFrom::kEachChild, SOBB_STRATEGY_K3, false},
    {BasisFrom::kEachChild, SOBB_STRATEGY_K2, false},
    {BasisFrom::kAxes, SOBB_STRATEGY_K2, false},
    {BasisFrom::kAverageExtents, SOBB_STRATEGY_K2, false},
    {BasisFrom::kAverageExtents, SOBB_STRATEGY_K3, false},
    {BasisFrom::kAverageExtents, SOBB_STRATEGY_K3, true},
    {BasisFrom::kSumOfAreas, SOBB_STRATEGY_K, false},
    {BasisFrom::kSumOfAreas, SOBB_STRATEGY_K2, false},
    {BasisFrom::kSumOfAreas, SOBB_STRATEGY_K3, false},
    {BasisFrom::kSumOfAreas, SOBB_STRATEGY_K, true},
    {BasisFrom::kSumOfAreas, SOBB_STRATEGY_K2, true},
    {BasisFrom::kSumOfAreas, SOBB_STRATEGY_K3, true},
    {BasisFrom::kSumOrAxes, SOBB_STRATEGY_K2, true},
    {BasisFrom::kSumOrAxes, SOBB_STRATEGY_K3, true},
};

Json measure_width(StudyScene& scene, const Topology& topology, uint32_t width,
                   WorkCounter& counter) {
  const FittedTree tree(scene, topology, width, default_directions(kPlanes));
  Json rules = Json::array();
  for (const BasisRule& rule : kRules) {
    const auto bases = tree.choose(rule);
    const AreaSums areas = tree.areas(bases);
    const Work work = counter.count(tree.bounded(bases));
    rules.push_back({{"rule", rule.name()},
                     {"inner_area", rounded(areas.inner)},
                     {"leaf_area", rounded(areas.leaf)},
                     {"work", to_json(work)}});
  }
  return {{"width", width}, {"nodes", tree.node_count()}, {"rules", rules}};
}

}  // namespace

int sharing(const StudyOptions& options) {
  write_report(options, "sharing", for_each_scene(options, [&](StudyScene& scene) {
                 const Topology topology = scene.build_topology();
                 const auto rays = scene.secondary_rays(options.size);
                 WorkCounter counter(rays, scene.scheduler());
                 Json widths = Json::array();
                 for (const uint32_t width : kWidths) {
                   widths.push_back(measure_width(scene, topology, width, counter));
                 }
                 return Json{{"rays", rays.size()}, {"widths", widths}};
               }));
  return 0;
}

}  // namespace sobb::study
