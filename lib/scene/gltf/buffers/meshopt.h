// SPDX-License-Identifier: Apache-2.0
// Decodes the elements of a buffer view that EXT_meshopt_compression or KHR_meshopt_compression has
// compressed, by libmeshoptimizer.
#pragma once

#include <string>
#include <string_view>

#include "scene/gltf/document/model.h"
#include "scene/model/scene_writer.h"

namespace sobb {

// Returns whether this build has libmeshoptimizer.
bool can_decode_meshopt();

// The elements, byte_stride bytes apart, which the writer holds; `data` are the compressed bytes,
// `place` is the view's. Errors: SCENE_SYNTAX; SCENE_UNSUPPORTED, with the extension's name, in a
// build without the library or for a mode or filter that it does not have; MEMORY_LIMIT; CANCELLED.
std::string decode_meshopt(const GltfMeshopt& view, std::string_view data, const std::string& place,
                           SceneWriter& writer);

}  // namespace sobb
