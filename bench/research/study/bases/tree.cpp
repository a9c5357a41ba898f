// SPDX-License-Identifier: Apache-2.0
#include "study/bases/tree.h"

#include "base/isa.h"
#include "bounds/area.h"
#include "bounds/bounds_kernels.h"
#include "builder/wide/collapse.h"

namespace sobb::study {
namespace {

constexpr uint64_t kGrain = 4096;

// Appends a treelet's nodes, whose indices the tree uses as they are.
void append(const Treelet& treelet, const References& references, Tree& tree) {
  for (const WideNode& wide : treelet.nodes) {
    tree.nodes.push_back({static_cast<uint32_t>(tree.children.size()), wide.child_count});
    for (uint32_t i = 0; i < wide.child_count; ++i) {
      if (!wide.is_leaf(i)) {
        tree.children.push_back({wide.index[i], 0});
        continue;
      }
      tree.children.push_back({static_cast<uint32_t>(tree.primitives.size()), wide.count[i]});
      const auto leaf = references.part(wide.first[i], wide.count[i]).primitives;
      tree.primitives.insert(tree.primitives.end(), leaf.begin(), leaf.end());
    }
  }
}

Direction direction_of(const DirectionTable& table, uint32_t k) {
  return {table.x[k], table.y[k], table.z[k]};
}

}  // namespace

Tree make_tree(const Topology& topology, uint32_t width, const Scheduler& scheduler,
               Memory& memory) {
  const WideTopology wide = collapse(topology, width, scheduler, memory);
  Tree tree;
  tree.depth = wide.depth;
  tree.nodes.reserve(wide.node_count);
  append(wide.top, wide.references, tree);
  for (const Treelet& treelet : wide.subtrees) append(treelet, wide.references, tree);
  return tree;
}

std::vector<Kdop> fit_children(const Tree& tree, const Mesh& mesh, const float centre[3],
                               const DirectionTable& directions, const Scheduler& scheduler) {
  const BoundsKernels& kernels = bounds_kernels(resolve_isa(SOBB_ISA_BEST));
  std::vector<Kdop> kdops(tree.children.size());
  scheduler.for_ranges(tree.children.size(), kGrain, [&](uint64_t begin, uint64_t end) {
    RelativePoint points[3 * kMaxLeafReferences];
    for (uint64_t at = begin; at < end; ++at) {
      const Tree::Child& child = tree.children[at];
      for (uint32_t i = 0; i < 3 * child.triangles; ++i) {
        const Point p = mesh.corner(tree.primitives[child.index + i / 3], static_cast<int>(i % 3));
        points[i] = {p.x - centre[0], p.y - centre[1], p.z - centre[2]};
      }
      if (child.is_leaf()) kernels.fit(directions, points, 3 * child.triangles, kdops[at]);
    }
  });
  for (size_t at = tree.children.size(); at-- > 0;) {
    if (tree.children[at].is_leaf()) continue;
    const Tree::Node& node = tree.nodes[tree.children[at].index];
    kdops[at] = kdops[node.first_child];
    for (uint32_t i = 1; i < node.child_count; ++i) kdops[at].merge(kdops[node.first_child + i]);
  }
  return kdops;
}

AreaSums sum_areas(const Tree& tree, const std::vector<Kdop>& kdops,
                   const std::vector<uint16_t>& bases, const DirectionTable& directions,
                   double box_area) {
  AreaSums sums;
  for (size_t at = 0; at < tree.children.size(); ++at) {
    Direction normal[3];
    double width[3];
    for (int j = 0; j < 3; ++j) {
      const uint32_t k = basis_direction(bases[at], j);
      normal[j] = direction_of(directions, k);
      width[j] = static_cast<double>(kdops[at].upper[k]) - kdops[at].lower[k];
    }
    (tree.children[at].is_leaf() ? sums.leaf : sums.inner) += slab_area(normal, width) / box_area;
  }
  return sums;
}

}  // namespace sobb::study
