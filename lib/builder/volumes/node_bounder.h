// SPDX-License-Identifier: Apache-2.0
// The k-DOPs of leaves and nodes, merged upward, and with them the bases of every node.
#pragma once

#include <memory_resource>
#include <optional>
#include <span>

#include "bounds/bounds_kernels.h"
#include "builder/boxes/frame.h"
#include "builder/boxes/references.h"
#include "builder/mesh.h"
#include "builder/volumes/node_bases.h"
#include "sobb/sobb.h"

namespace sobb {

// The scene that volumes are made of.
struct VolumeScene {
  const Mesh& mesh;
  const Frame& frame;  // in which the topology was built
  std::span<const Direction> directions;
  float centre[3];  // slabs are measured from it
  float radius;     // no vertex is further from the centre
};

class NodeBounder {
 public:
  // Chooses bases by `strategy`; without one all bases are the frame, and k-DOPs have its three
  // slabs only.
  NodeBounder(const VolumeScene& scene, std::optional<sobb_strategy> strategy,
              const BoundsKernels& kernels, std::pmr::memory_resource& memory);

  void bound_leaf(const References& leaf, BoundedChild& bounded) const;

  // Bounds a node by its children, and chooses these children's bases.
  NodeBases bound_node(uint32_t count, const BoundedChild* const* child,
                       BoundedChild& bounded) const;

 private:
  VolumeScene scene_;
  const BoundsKernels& kernels_;
  DirectionTable directions_;
  std::optional<NodeBasisChooser> chooser_;
};

}  // namespace sobb
