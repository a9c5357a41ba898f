// SPDX-License-Identifier: Apache-2.0
// Decodes the triangles of a primitive that KHR_draco_mesh_compression has compressed, by libdraco.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "scene/model/scene_writer.h"

namespace sobb {

struct DracoTriangles {
  std::string positions;   // three components per point
  int component_type = 0;  // of positions, as glTF numbers them
  uint64_t point_count = 0;
  std::string indices;  // uint32_t, three per triangle
  uint64_t triangle_count = 0;
};

// Returns whether this build has libdraco.
bool can_decode_draco();

// The points and triangles of the compressed bytes `data`, which the writer holds; `position_id` is
// Draco's id of the positions, `place` is the primitive's. No other attribute is decoded, but for
// those that are coded as one with the positions. Errors: SCENE_SYNTAX, with the extension's name;
// SCENE_UNSUPPORTED, with that name, in a build without the library; MEMORY_LIMIT; CANCELLED.
DracoTriangles decode_draco(std::string_view data, uint32_t position_id, const std::string& place,
                            SceneWriter& writer);

}  // namespace sobb
