// SPDX-License-Identifier: Apache-2.0
// Reads views from a JSON file, as sobb_scene_options in capi/include/sobb/scene.h describes it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/model/scene_writer.h"

namespace sobb {

// The views that `text`, the JSON of the file at `path`, has under `stem`; none where it has no
// such member. Errors: SCENE_SYNTAX with the file and the place; MEMORY_LIMIT, CANCELLED by the
// writer.
std::vector<sobb_view> parse_views(std::string_view text, const std::string& path,
                                   std::string_view stem, SceneWriter& writer);

// Reads the file at `path` and parses it as above. Errors: FILE_OPEN, FILE_READ too.
std::vector<sobb_view> read_views(const std::string& path, std::string_view stem,
                                  SceneWriter& writer);

}  // namespace sobb
