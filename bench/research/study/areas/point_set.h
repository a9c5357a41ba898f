// SPDX-License-Identifier: Apache-2.0
// PointSet holds the vertices below a node, and measures their width along any direction.
#pragma once

#include <cstdint>
#include <vector>

#include "bounds/basis.h"
#include "builder/boxes/box.h"
#include "builder/mesh.h"
#include "builder/topology/topology.h"

namespace sobb::study {

class PointSet {
 public:
  // Each vertex once, relative to the middle of the node's box: widths then round relative to the
  // node's size, not to the scene's.
  PointSet(const Mesh& mesh, const Topology& topology, const TopologyNode& node);

  // max n . p - min n . p; n has unit length.
  double width(const Direction& n) const;

  size_t size() const { return size_; }
  Point point(size_t i) const { return {x_[i], y_[i], z_[i]}; }

 private:
  size_t size_ = 0;
  std::vector<float> x_, y_, z_;  // padded to whole vectors with the last point
};

}  // namespace sobb::study
