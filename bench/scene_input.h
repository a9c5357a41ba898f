// SPDX-License-Identifier: Apache-2.0
// SceneInput holds the scene: one array of vertices and one of indices, which the library and
// Embree both read.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sobb/scene.h"

namespace sobb::bench {

class SceneInput {
 public:
  /// @p cameras is a file of views; empty for the scene's own.
  SceneInput(const std::string& source, const std::string& cameras, uint64_t view);

  const sobb_triangles& triangles() const { return triangles_; }
  const sobb_scene_info& info() const { return info_; }
  const sobb_view& view() const { return view_; }

 private:
  std::shared_ptr<sobb_scene> scene_;
  std::vector<float> vertices_;
  sobb_triangles triangles_ = SOBB_TRIANGLES_INIT;
  sobb_scene_info info_ = SOBB_SCENE_INFO_INIT;
  sobb_view view_{};
};

}  // namespace sobb::bench
