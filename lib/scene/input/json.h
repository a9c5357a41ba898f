// SPDX-License-Identifier: Apache-2.0
// Parses JSON text into a tree whose size is bounded before.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "scene/model/scene_writer.h"

namespace sobb {

// The signs of a text, JSON or not, counted without a parser: they bound the tree that it may
// become. Two bytes of text may be a hundred of a tree, so the bound is held against the memory
// limit first.
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

  uint64_t tree_bytes() const;   // the most that the tree takes
  uint64_t parse_bytes() const;  // the most that tree and parser take until the tree is made
};
JsonSize measure_json(std::string_view text);

// Refuses JSON that needs more memory than the writer has left, or more than 4 GiB where it has no
// limit. Error MEMORY_LIMIT, with `name`.
void check_json_room(uint64_t bytes, const std::string& name, const SceneWriter& writer);

// Errors: SCENE_SYNTAX, with `name` and the line and column, for text that is not JSON or is nested
// so deeply that code which recurses over the tree would not be safe; MEMORY_LIMIT; CANCELLED.
nlohmann::json parse_json(std::string_view text, const std::string& name, SceneWriter& writer);

// Throws SCENE_SYNTAX: the document `name` is wrong at `place`, as in "nodes[3].mesh" "is not a
// number".
[[noreturn]] void refuse_json(const std::string& name, const std::string& place, const char* what);

}  // namespace sobb
