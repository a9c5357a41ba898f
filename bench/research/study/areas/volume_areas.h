// SPDX-License-Identifier: Apache-2.0
// VolumeAreas measures the area that every volume of the paper has around the same points.
#pragma once

#include <deque>
#include <memory_resource>
#include <string>
#include <vector>

#include "bounds/basis_table.h"
#include "bounds/bounds_kernels.h"
#include "builder/mesh.h"
#include "study/areas/free_normals.h"
#include "study/areas/point_set.h"
#include "volumes/tables.h"

namespace sobb::study {

class VolumeAreas {
 public:
  VolumeAreas(const MeshSummary& summary, std::pmr::memory_resource& memory);

  // AABB, 14-DOP, OBB, then SOBB 32 to 256, each by k, k2, k3, and by the better of k2 and the
  // axes.
  const std::vector<std::string>& names() const { return names_; }

  struct Areas {
    std::vector<double> by_method;
    std::vector<Normals> normals;  // of the best volumes, where a search may start
  };
  Areas measure(const PointSet& points) const;

 private:
  struct Table {
    uint32_t k;
    std::span<const Direction> directions;
    BasisTable bases;
  };

  std::vector<std::string> names_;
  const BoundsKernels& kernels_;
  Tables dop14_;  // the OBB is made of its extremal points
  std::deque<Table> tables_;
};

}  // namespace sobb::study
