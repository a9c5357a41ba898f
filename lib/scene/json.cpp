// SPDX-License-Identifier: Apache-2.0
// See json.h.
#include "scene/json.h"

#include "base/error.h"

namespace sobb {

nlohmann::json parse_json(std::string_view text, const std::string& name) {
  constexpr int kMaxDepth = 128;
  const auto limit_depth = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    if (depth > kMaxDepth) {
      fail(SOBB_ERROR_SCENE_SYNTAX, "%s: JSON nested deeper than %d levels", name.c_str(),
           kMaxDepth);
    }
    return true;
  };
  try {
    return nlohmann::json::parse(text.begin(), text.end(), limit_depth);
  } catch (const nlohmann::json::exception& error) {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: %s", name.c_str(), error.what());
  }
}

}  // namespace sobb
