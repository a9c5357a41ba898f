// SPDX-License-Identifier: Apache-2.0
// Loads a scene: by a path's ending, or a built-in one by its name.
#pragma once

#include <cstdint>
#include <string>

#include "base/progress.h"
#include "scene/scene.h"

namespace sobb {

// As sobb_scene_load() in capi/include/sobb/scene.h; `views_path` and `progress` may be null.
Scene load_scene(const std::string& source, const char* views_path, uint64_t memory_limit,
                 Progress* progress = nullptr);

}  // namespace sobb
