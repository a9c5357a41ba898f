// SPDX-License-Identifier: Apache-2.0
// The node hierarchy of a glTF file (specification, section 3.5), flattened.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "scene/gltf/model.h"

namespace sobb {

// x -> linear x + translation, rows first.
struct GltfTransform {
  std::array<std::array<double, 3>, 3> linear{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<double, 3> translation{};
  bool identity = true;  // then points keep their very bits

  std::array<double, 3> point(const std::array<double, 3>& p) const;
  std::array<double, 3> vector(const std::array<double, 3>& v) const;
};

struct GltfPlacedNode {
  int node = -1;
  GltfTransform transform;  // to the world
};

// Every node of the scene to show, parents before children, siblings in the file's order: of the
// default scene, else of the first, else of all roots. Error SCENE_SYNTAX for a node that does not
// exist or is reached twice, as in a cycle.
std::vector<GltfPlacedNode> place_gltf_nodes(const tinygltf::Model& model, const std::string& name);

}  // namespace sobb
