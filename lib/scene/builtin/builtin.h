// SPDX-License-Identifier: Apache-2.0
// Built-in scenes by name: builtin:NAME[:TRIANGLES][@DEGREES].
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene/oblique_turn.h"
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

// The turn that the name asks for.
ObliqueTurn turn_of(const BuiltinName& name);

// Writes the scene's triangles, turned; returns its views, turned.
std::vector<sobb_view> make_builtin(const BuiltinName& name, SceneWriter& writer);

}  // namespace sobb
