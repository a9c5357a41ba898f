// SPDX-License-Identifier: Apache-2.0
// Splits a GLB, the binary container of glTF 2.0 (specification, section 4), into its chunks.
#pragma once

#include <optional>
#include <string_view>

#include "scene/model/scene_writer.h"

namespace sobb {

struct GlbChunks {
  std::string_view json;
  std::optional<std::string_view> binary;
};

bool is_glb(std::string_view bytes);

// Unknown chunks are ignored, and bytes behind the last chunk are noted. Errors: SCENE_SYNTAX where
// the header or a chunk that is read promises more than the file has; SCENE_UNSUPPORTED for another
// version.
GlbChunks split_glb(std::string_view bytes, SceneWriter& writer);

}  // namespace sobb
