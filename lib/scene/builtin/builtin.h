// SPDX-License-Identifier: Apache-2.0
// Makes built-in scenes by name: builtin:NAME[:TRIANGLES][@DEGREES].
//
// The room builtin/ makes scenes without a file: each of scenes.h has a source file of its own,
// which writes parts (parts.h) with the arithmetic of model/vec3.h and random.h.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene/model/oblique_turn.h"
#include "scene/model/scene_writer.h"

namespace sobb {

struct BuiltinName {
  std::string scene;
  uint64_t triangles = 250'000;
  double degrees = 0;
};

bool is_builtin(std::string_view source);

// Errors: SCENE_FORMAT for a scene that is not known, with the list of those that are; SCENE_SYNTAX
// for a number that is none or out of range.
BuiltinName parse_builtin(const std::string& source);

// The turn that the name asks for, of what is relative to an origin.
ObliqueTurn turn_of(const BuiltinName& name, Vec3 origin = {});

// Writes the scene's triangles, turned; returns its views, turned, both relative to the writer's
// origin.
std::vector<sobb_view> make_builtin(const BuiltinName& name, SceneWriter& writer);

}  // namespace sobb
