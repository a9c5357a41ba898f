// SPDX-License-Identifier: Apache-2.0
// Places the nodes of a glTF file (specification, section 3.5) in the world.
#pragma once

#include <array>
#include <vector>

#include "scene/gltf/document/model.h"
#include "scene/model/scene_writer.h"

namespace sobb {

// x -> linear x + translation; `linear` is an array of rows.
struct GltfTransform {
  std::array<std::array<double, 3>, 3> linear{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<double, 3> translation{};
  bool identity = true;  // whoever transforms then keeps the points' bits

  std::array<double, 3> point(const std::array<double, 3>& p) const;
  std::array<double, 3> vector(const std::array<double, 3>& v) const;
};

struct GltfPlacedNode {
  int node = -1;
  GltfTransform transform;  // to the world
};

// Every node of the scene to show, parents before children, siblings in the file's order. That is
// the default scene, else the first, else all roots; a hidden node is left out, and so are those
// below it. A node of several parents is placed below each. Errors: SCENE_SYNTAX for a node that is
// malformed, does not exist or is below itself; TOO_LARGE, MEMORY_LIMIT, CANCELLED.
std::vector<GltfPlacedNode> place_gltf_nodes(const GltfDocument& document, SceneWriter& writer);

}  // namespace sobb
