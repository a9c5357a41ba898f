// SPDX-License-Identifier: Apache-2.0
// JSON text to a tree, of a size known before.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "scene/scene_writer.h"

namespace sobb {

// A text's signs, counted without a parser: bounds of what it may become, JSON or not. Two bytes
// of text may be a hundred of a tree, so this is held against the memory limit first.
struct JsonSize {
  uint64_t commas = 0;
  uint64_t colons = 0;
  uint64_t objects = 0;
  uint64_t arrays = 0;
  uint64_t strings = 0;
  uint64_t string_bytes = 0;  // within quotes
  uint64_t other_bytes = 0;
  uint64_t longest_token = 0;
  uint64_t depth = 0;

  uint64_t tree_bytes() const;   // the most that its tree takes
  uint64_t parse_bytes() const;  // and the parser until it is made
};
JsonSize measure_json(std::string_view text);

// Refuses JSON that needs more memory than the writer has left, or than 4 GiB where it has no
// limit. Error MEMORY_LIMIT, with `name`.
void check_json_room(uint64_t bytes, const std::string& name, const SceneWriter& writer);

// Errors: SCENE_SYNTAX, with `name` and the line and column, for text that is not JSON or is nested
// so deeply that code which recurses over the tree would not be safe; MEMORY_LIMIT; CANCELLED.
nlohmann::json parse_json(std::string_view text, const std::string& name, SceneWriter& writer);

}  // namespace sobb
