// SPDX-License-Identifier: Apache-2.0
// What does another direction table bring? The answer has areas of the binary hierarchy, and the
// volumes and triangles that a secondary ray tests there and on the library's 8-wide nodes.
#include <algorithm>
#include <filesystem>

#include "builder/boxes/frame.h"
#include "builder/scene_directions.h"
#include "study/bases/direction_file.h"
#include "study/bases/fitted_tree.h"
#include "study/study_scene.h"

namespace sobb::study {
namespace {

constexpr uint32_t kPlanes[] = {32, 48, 64};
constexpr BasisRule kAxes = {BasisFrom::kAxes, SOBB_STRATEGY_K2, false};
constexpr BasisRule kOwn = {BasisFrom::kEachChild, SOBB_STRATEGY_K3, false};
constexpr BasisRule kShared = {BasisFrom::kSumOrAxes, SOBB_STRATEGY_K2, true};

struct NamedTable {
  std::string name;
  DirectionSet set;
};

NamedTable default_table(uint32_t k) {
  return {k == 6 ? "AABB" : "default " + std::to_string(k),
          default_direction_set(k, *std::pmr::get_default_resource())};
}

NamedTable fitted_table(StudyScene& scene, uint32_t k) {
  const auto set = scene_directions(scene.mesh(), k, scene.scheduler(), scene.memory());
  return {"fitted " + std::to_string(k), set};
}

// A table of text. Where it begins with the axes, its topology is built along them.
NamedTable read_table(const std::string& path) {
  const std::vector<Direction> directions = read_directions(path);
  const auto axes = default_directions(6);
  const bool along_axes = std::equal(axes.begin(), axes.end(), directions.begin(),
                                     [](const Direction& a, const Direction& b) {
                                       return a.x == b.x && a.y == b.y && a.z == b.z;
                                     });
  return {
      std::filesystem::path(path).stem().string(),
      {{directions.begin(), directions.end()}, along_axes ? SOBB_TABLE_SPREAD : SOBB_TABLE_FITTED}};
}

Json measure_width(StudyScene& scene, const Topology& topology, uint32_t width,
                   const std::pmr::vector<Direction>& directions, const BasisRule& rule,
                   WorkCounter& counter) {
  const FittedTree tree(scene, topology, width, directions);
  const auto bases = tree.choose(rule);
  const AreaSums areas = tree.areas(bases);
  const Work work = counter.count(tree.bounded(bases));
  return {{"rule", rule.name()},
          {"inner_area", rounded(areas.inner)},
          {"leaf_area", rounded(areas.leaf)},
          {"work", to_json(work)}};
}

Json measure_table(StudyScene& scene, const NamedTable& table, WorkCounter& counter) {
  const auto& directions = table.set.directions;
  const Frame frame(table.set, scene.summary().centre);
  const Topology topology = scene.build_topology(frame);
  const bool aabb = directions.size() == 3;
  return {{"table", table.name},
          {"binary", measure_width(scene, topology, 2, directions, aabb ? kAxes : kOwn, counter)},
          {"wide", measure_width(scene, topology, 8, directions, aabb ? kAxes : kShared, counter)}};
}

}  // namespace

int tables(const StudyOptions& options) {
  std::vector<NamedTable> tables;
  tables.push_back(default_table(6));
  for (const uint32_t k : kPlanes) tables.push_back(default_table(k));
  for (const std::string& path : options.directions) {
    tables.push_back(read_table(path));
  }
  write_report(options, "tables", for_each_scene(options, [&](StudyScene& scene) {
                 const auto rays = scene.secondary_rays(options.size);
                 WorkCounter counter(rays, scene.scheduler());
                 Json rows = Json::array();
                 for (const NamedTable& table : tables) {
                   rows.push_back(measure_table(scene, table, counter));
                 }
                 for (const uint32_t k : kPlanes) {
                   rows.push_back(measure_table(scene, fitted_table(scene, k), counter));
                 }
                 return Json{{"rays", rays.size()}, {"tables", rows}};
               }));
  return 0;
}

}  // namespace sobb::study
