// SPDX-License-Identifier: Apache-2.0
// Splits a GLB, the binary container of glTF 2.0 (specification, section 4), into its chunks.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sobb {

struct GlbChunks {
  std::string_view json;
  std::optional<std::string_view> binary;
};

bool is_glb(std::string_view bytes);

// Error SCENE_SYNTAX where the header or a chunk promises more than the file has, SCENE_UNSUPPORTED
// for another version.
GlbChunks split_glb(std::string_view bytes, const std::string& name);

}  // namespace sobb
