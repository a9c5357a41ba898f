// SPDX-License-Identifier: Apache-2.0
#include "study/areas/point_set.h"

#include <algorithm>
#include <limits>

namespace sobb::study {
namespace {

constexpr size_t kLanes = 8;

void gather_vertices(const Mesh& mesh, const Topology& topology, const TopologyNode& node,
                     std::vector<uint32_t>& vertices) {
  if (!node.is_leaf) {
    for (int i = 0; i < 2; ++i) gather_vertices(mesh, topology, topology.child(node, i), vertices);
    return;
  }
  for (const uint32_t primitive : topology.references().part(node.first, node.count).primitives) {
    for (int i = 0; i < 3; ++i) vertices.push_back(mesh.index(primitive, i));
  }
}

}  // namespace

PointSet::PointSet(const Mesh& mesh, const Topology& topology, const TopologyNode& node) {
  std::vector<uint32_t> vertices;
  gather_vertices(mesh, topology, node, vertices);
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  size_ = vertices.size();
  const size_t padded = (size_ + kLanes - 1) / kLanes * kLanes;
  const auto middle = [&](int k) {
    return (static_cast<double>(node.box.lower[k]) + node.box.upper[k]) / 2;
  };
  for (size_t i = 0; i < padded; ++i) {
    const Point p = mesh.vertex(vertices[std::min(i, size_ - 1)]);
    x_.push_back(static_cast<float>(p.x - middle(0)));
    y_.push_back(static_cast<float>(p.y - middle(1)));
    z_.push_back(static_cast<float>(p.z - middle(2)));
  }
}

double PointSet::width(const Direction& n) const {
  float lower[kLanes];
  float upper[kLanes];
  std::fill(lower, lower + kLanes, std::numeric_limits<float>::infinity());
  std::fill(upper, upper + kLanes, -std::numeric_limits<float>::infinity());
  for (size_t i = 0; i < x_.size(); i += kLanes) {
    for (size_t lane = 0; lane < kLanes; ++lane) {
      const float along = n.x * x_[i + lane] + n.y * y_[i + lane] + n.z * z_[i + lane];
      lower[lane] = along < lower[lane] ? along : lower[lane];
      upper[lane] = along > upper[lane] ? along : upper[lane];
    }
  }
  return static_cast<double>(*std::max_element(upper, upper + kLanes)) -
         *std::min_element(lower, lower + kLanes);
}

}  // namespace sobb::study
