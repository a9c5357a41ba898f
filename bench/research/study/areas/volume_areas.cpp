// SPDX-License-Identifier: Apache-2.0
#include "study/areas/volume_areas.h"

#include <algorithm>

#include "base/isa.h"
#include "bounds/area.h"
#include "volumes/ditetrahedron.h"
#include "volumes/dop_area.h"

namespace sobb::study {
namespace {

constexpr uint32_t kPlanes[] = {32, 48, 64, 128, 256};

struct NamedStrategy {
  const char* name;
  sobb_strategy strategy;
};
constexpr NamedStrategy kStrategies[] = {
    {"k", SOBB_STRATEGY_K}, {"k2", SOBB_STRATEGY_K2}, {"k3", SOBB_STRATEGY_K3}};

constexpr Normals kAxes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr Method kDop14 = {"14-DOP", VolumeKind::kDop14, 14};

ExtremalPoints extremal_points(const Tables& dop14, const PointSet& points) {
  std::vector<RelativePoint> relative;
  for (size_t i = 0; i < points.size(); ++i) {
    const Point p = points.point(i);
    relative.push_back({p.x, p.y, p.z});
  }
  ExtremalPoints extremal{};
  extremal.fit(dop14, relative.data(), relative.size());
  return extremal;
}

}  // namespace

VolumeAreas::VolumeAreas(const MeshSummary& summary, std::pmr::memory_resource& memory)
    : names_{"AABB", "14-DOP", "OBB"},
      kernels_(bounds_kernels(resolve_isa(SOBB_ISA_BEST))),
      dop14_(kDop14, SOBB_STRATEGY_K2, kernels_, summary, memory) {
  for (const uint32_t k : kPlanes) {
    const auto directions = default_directions(k);
    tables_.push_back({k, directions, BasisTable(directions, memory)});
    for (const NamedStrategy& s : kStrategies) {
      names_.push_back("SOBB " + std::to_string(k) + " " + s.name);
    }
    names_.push_back("SOBB " + std::to_string(k) + " k2 or axes");
  }
}

VolumeAreas::Areas VolumeAreas::measure(const PointSet& points) const {
  Areas areas;
  const ExtremalPoints extremal = extremal_points(dop14_, points);
  Normals obb;
  ditetrahedron_basis(extremal, obb.data());
  const double aabb = area_with(points, kAxes);
  areas.by_method.push_back(aabb);
  areas.by_method.push_back(dop_area(dop14_.directions, extremal.along));
  areas.by_method.push_back(std::min(aabb, area_with(points, obb)));
  areas.normals = {kAxes, obb};
  for (const Table& table : tables_) {
    double least_k2 = 0;
    std::vector<float> width(table.bases.stride());
    for (size_t k = 0; k < table.directions.size(); ++k) {
      width[k] = static_cast<float>(points.width(table.directions[k]));
    }
    const float scale = 1 / *std::max_element(width.begin(), width.end());
    for (float& w : width) w *= scale;
    for (const NamedStrategy& s : kStrategies) {
      const TripleChoice choice = kernels_.choose_one(table.bases, width.data(), s.strategy);
      Normals normals;
      double chosen_width[3];
      for (size_t j = 0; j < 3; ++j) {
        normals[j] = table.directions[choice.direction[j]];
        chosen_width[j] = static_cast<double>(width[choice.direction[j]]) / scale;
      }
      areas.by_method.push_back(slab_area(normals.data(), chosen_width));
      if (s.strategy == SOBB_STRATEGY_K2) least_k2 = areas.by_method.back();
      if (s.strategy == SOBB_STRATEGY_K3 && table.k >= 64) areas.normals.push_back(normals);
    }
    areas.by_method.push_back(std::min(least_k2, aabb));
  }
  return areas;
}

}  // namespace sobb::study
