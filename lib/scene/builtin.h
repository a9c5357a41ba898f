// SPDX-License-Identifier: Apache-2.0
// Built-in scenes by name: builtin:NAME[:TRIANGLES][@DEGREES].
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene_writer.h"

namespace sobb {

struct BuiltinName {
  std::string scene;
  uint64_t triangles = 250'000;
  double degrees = 0;
};

bool is_builtin(std::string_view source);

// Errors: SCENE_FORMAT for a scene that is not known, with those that are; SCENE_SYNTAX for a
// number that is none or out of range.
BuiltinName parse_builtin(const std::string& source);

// Writes the scene's triangles; returns its views.
std::vector<sobb_view> make_builtin(const BuiltinName& name, SceneWriter& writer);

}  // namespace sobb
