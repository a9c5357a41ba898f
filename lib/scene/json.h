// SPDX-License-Identifier: Apache-2.0
// JSON text to a tree.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace sobb {

// Error SCENE_SYNTAX, with `name` and the line and column, for text that is not JSON or is nested
// so deeply that code which recurses over the tree would not be safe.
nlohmann::json parse_json(std::string_view text, const std::string& name);

}  // namespace sobb
