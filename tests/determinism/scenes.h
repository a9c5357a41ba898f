// SPDX-License-Identifier: Apache-2.0
// Scenes that are the same bits on every machine.
#pragma once

#include <stdexcept>
#include <vector>

#include "sobb/scene.h"
#include "support/soups.h"

namespace sobb::test {

inline Soup builtin_soup(const std::string& name) {
  sobb_scene* scene = nullptr;
  sobb_triangles triangles = SOBB_TRIANGLES_INIT;
  if (sobb_scene_load(("builtin:" + name).c_str(), nullptr, &scene) != SOBB_OK ||
      sobb_scene_triangles(scene, &triangles) != SOBB_OK) {
    throw std::runtime_error(sobb_last_error());
  }
  Soup soup{name,
            {triangles.vertices, triangles.vertices + 3 * triangles.vertex_count},
            {triangles.indices, triangles.indices + 3 * triangles.triangle_count}};
  sobb_scene_release(scene);
  return soup;
}

// Large enough for several threads.
inline std::vector<Soup> determinism_scenes() {
  std::vector<Soup> scenes;
  for (const char* name : {"hairball:10000", "pipes:10000@30"}) {
    scenes.push_back(builtin_soup(name));
  }
  scenes.push_back(degenerate_soup(1, 3000));
  return scenes;
}

}  // namespace sobb::test
