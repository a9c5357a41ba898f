// SPDX-License-Identifier: Apache-2.0
// The formats of scene files, each with the ending that tells it and the function that reads it.
#pragma once

#include <string>
#include <string_view>

#include "scene/model/scene_writer.h"

namespace sobb {

// A path as the loader takes it apart: folder/stem.ending.
struct PathParts {
  std::string folder;  // with its slash
  std::string stem;
  std::string ending;  // in lower case, without its dot
};
PathParts split_path(const std::string& path);

// Reads the whole of a file, whose path is the writer's name; the caller finishes the writer.
using FormatReader = void (*)(std::string_view bytes, SceneWriter& writer);

// The reader of files with this ending, in lower case; null where the ending is not known.
FormatReader find_format(std::string_view ending);

// The known endings, for messages: ".gltf, .glb, …".
std::string known_endings();

}  // namespace sobb
