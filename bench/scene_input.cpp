// SPDX-License-Identifier: Apache-2.0
// SceneInput loads the scene through the importers' C functions.
#include "scene_input.h"

#include <cstring>

#include "check.h"

namespace sobb::bench {

SceneInput::SceneInput(const std::string& source, const std::string& cameras, uint64_t view) {
  sobb_scene_options options = SOBB_SCENE_OPTIONS_INIT;
  options.views_path = cameras.empty() ? nullptr : cameras.c_str();
  sobb_scene* scene = nullptr;
  check(sobb_scene_load(source.c_str(), &options, &scene));
  scene_.reset(scene, sobb_scene_release);

  check(sobb_scene_get_info(scene, &info_));
  check(sobb_scene_view(scene, view, &view_));
  check(sobb_scene_triangles(scene, &triangles_));

  // Embree reads 16 bytes at every vertex, so the last one needs four more behind it.
  vertices_.resize(3 * triangles_.vertex_count + 1);
  const uint64_t stride = triangles_.vertex_stride == 0 ? 12 : triangles_.vertex_stride;
  const char* from = reinterpret_cast<const char*>(triangles_.vertices);
  for (uint64_t i = 0; i < triangles_.vertex_count; ++i) {
    std::memcpy(&vertices_[3 * i], from + i * stride, 12);
  }
  triangles_.vertices = vertices_.data();
  triangles_.vertex_stride = 12;
}

}  // namespace sobb::bench
