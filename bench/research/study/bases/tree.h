// SPDX-License-Identifier: Apache-2.0
// Tree is the shape of a hierarchy: nodes of up to some width, their children, the triangles of
// leaves. Volumes are arrays beside it, with one value per child.
#pragma once

#include <cstdint>
#include <vector>

#include "base/memory.h"
#include "base/scheduler.h"
#include "bounds/directions/direction_table.h"
#include "bounds/kdop.h"
#include "builder/mesh.h"
#include "builder/topology/topology.h"

namespace sobb::study {

struct Tree {
  struct Child {
    uint32_t index;      // a node's, or that of a leaf's first primitive
    uint32_t triangles;  // in a leaf; 0 for a node

    bool is_leaf() const { return triangles != 0; }
  };
  struct Node {
    uint32_t first_child;
    uint32_t child_count;
  };

  std::vector<Node> nodes;  // parents before their children; the first is the root
  std::vector<Child> children;
  std::vector<uint32_t> primitives;  // leaf by leaf
  uint32_t depth = 0;                // nodes on the longest path from the root
};

// Collapses a binary topology to nodes of up to 2, 4 or 8 children, as the library does.
Tree make_tree(const Topology& topology, uint32_t width, const Scheduler& scheduler,
               Memory& memory);

// The k-DOP of every child, relative to the centre.
std::vector<Kdop> fit_children(const Tree& tree, const Mesh& mesh, const float centre[3],
                               const DirectionTable& directions, const Scheduler& scheduler);

// The sums of a hierarchy's areas that the paper's table has, divided by the area of the scene's
// box.
struct AreaSums {
  double inner = 0;
  double leaf = 0;
};

// Sums the areas of children whose volumes have three slabs of a k-DOP, which a basis selects.
AreaSums sum_areas(const Tree& tree, const std::vector<Kdop>& kdops,
                   const std::vector<uint16_t>& bases, const DirectionTable& directions,
                   double box_area);

}  // namespace sobb::study
