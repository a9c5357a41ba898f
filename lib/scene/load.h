// SPDX-License-Identifier: Apache-2.0
// Loads a scene: a file by its path's ending, or a built-in scene by its name.
//
// The rooms of lib/scene, each of which knows only those before it:
//   model/                      the scene in memory, and the writer that every reader fills it with
//   input/                      what readers of files share
//   views/                      views from a file, from cameras, and the default one
//   text/, gltf/, builtin/      where triangles come from; these do not know each other
//   subdivision/                refines a finished scene
// Above them formats.h lists the formats, source_name.h takes a source's name apart, and
// load_scene() goes through all of it.
#pragma once

#include <cstdint>
#include <string>

#include "base/progress.h"
#include "scene/model/scene.h"

namespace sobb {

// Does what sobb_scene_load() in capi/include/sobb/scene.h promises. `views_path` and `progress`
// may be null; `origin` is finite.
Scene load_scene(const std::string& source, const char* views_path, uint64_t memory_limit,
                 Progress* progress = nullptr, Vec3 origin = {});

}  // namespace sobb
