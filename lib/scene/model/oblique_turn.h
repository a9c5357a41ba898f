// SPDX-License-Identifier: Apache-2.0
// Turned scenes, SOURCE@DEGREES. Models along the axes flatter axis-aligned boxes; a turn about an
// oblique axis takes that advantage away.
#pragma once

#include <string>
#include <string_view>

#include "base/progress.h"
#include "scene/model/scene.h"
#include "scene/model/vec3.h"

namespace sobb {

// A turn about the axis (1, 2, 3) through a point.
class ObliqueTurn {
 public:
  ObliqueTurn(double degrees, Vec3 centre);
  Vec3 point(Vec3 p) const;
  Vec3 vector(Vec3 v) const;
  sobb_view view(const sobb_view& view) const;

 private:
  bool identity_;
  SinCos angle_;
  Vec3 centre_;
};

// Parses what follows the '@' of a source. Error SCENE_SYNTAX, naming `source`, where that is no
// number from -360 to 360.
double parse_degrees(const std::string& source, std::string_view text);

// Turns a finished scene and its views about the centre of its box, and measures it again. Errors:
// TOO_LARGE, naming `source`, where a turned vertex is beyond 2^60; CANCELLED.
void turn_scene(const std::string& source, double degrees, Scene& scene, Progress* progress);

}  // namespace sobb
