// SPDX-License-Identifier: Apache-2.0
#include "format/statistics.h"

#include "bounds/area.h"

namespace sobb {
namespace {

double box_area(const BuildRecord& record) {
  double size[3];
  for (int k = 0; k < 3; ++k) {
    size[k] = static_cast<double>(record.bounds_max[k]) - record.bounds_min[k];
  }
  return 2 * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]);
}

template <int W>
double child_area(const Node<W>& node, uint32_t child, std::span<const Direction> directions) {
  Direction normal[3];
  double width[3];
  for (int j = 0; j < 3; ++j) {
    normal[j] = directions[basis_direction(node.basis[child], j)];
    width[j] = static_cast<double>(node.slab[j][1][child]) - node.slab[j][0][child];
  }
  return slab_area(normal, width);
}

template <int W>
Statistics measure_nodes(const FileView& view) {
  Statistics sum;
  for (const Node<W>& node : view.nodes_of<W>()) {
    for (uint32_t i = 0; i < child_count(node); ++i) {
      const bool leaf = (node.meta[i] & kLeafBit) != 0;
      sum.leaves += leaf;
      (leaf ? sum.leaf_area : sum.inner_area) += child_area(node, i, view.directions);
    }
    if (on_frame(node)) {
      ++sum.axes_nodes;
    } else {
      ++((node.meta[0] & kSharedBit) != 0 ? sum.shared_nodes : sum.own_nodes);
    }
  }
  const double whole = box_area(*view.record);
  sum.inner_area = whole > 0 ? sum.inner_area / whole : 0;
  sum.leaf_area = whole > 0 ? sum.leaf_area / whole : 0;
  return sum;
}

}  // namespace

Statistics measure(const FileView& view) {
  return view.header->width == 4 ? measure_nodes<4>(view) : measure_nodes<8>(view);
}

}  // namespace sobb
