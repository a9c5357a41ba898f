// SPDX-License-Identifier: Apache-2.0
// See oblique_turn.h.
#include "scene/model/oblique_turn.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "scene/model/measure.h"

namespace sobb {
namespace {

constexpr double kMostDegrees = 360;
constexpr size_t kNumbersAtOnce = 3 << 18;  // progress is reported between them

}  // namespace

ObliqueTurn::ObliqueTurn(double degrees, Vec3 centre)
    : identity_(degrees == 0), angle_(sin_cos(degrees / 360)), centre_(centre) {}

// Rodrigues: about the unit axis a, v goes to v cos + (a x v) sin + a (a . v) (1 - cos).
Vec3 ObliqueTurn::vector(Vec3 v) const {
  if (identity_) return v;
  const Vec3 axis = normalized({1, 2, 3});
  return angle_.cos * v + angle_.sin * cross(axis, v) + (1 - angle_.cos) * dot(axis, v) * axis;
}

Vec3 ObliqueTurn::point(Vec3 p) const { return identity_ ? p : centre_ + vector(p - centre_); }

sobb_view ObliqueTurn::view(const sobb_view& view) const {
  sobb_view turned = view;
  narrow(point(widen(view.eye)), turned.eye);
  narrow(point(widen(view.target)), turned.target);
  narrow(vector(widen(view.up)), turned.up);
  return turned;
}

double parse_degrees(const std::string& source, std::string_view text) {
  double degrees = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, degrees);
  if (parsed.ec != std::errc() || parsed.ptr != end || !(std::fabs(degrees) <= kMostDegrees)) {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: after '@' comes a number of degrees from -360 to 360",
         source.c_str());
  }
  return degrees;
}

void turn_scene(const std::string& source, double degrees, Scene& scene, Progress* progress) {
  const ObliqueTurn turn(degrees, box_centre(scene));
  for (size_t i = 0; i < scene.vertices.size(); i += 3) {
    if (progress != nullptr && i % kNumbersAtOnce == 0) progress->check(1, 1, 1);
    float* vertex = &scene.vertices[i];
    narrow(turn.point(widen(vertex)), vertex);
    if (std::any_of(vertex, vertex + 3,
                    [](float x) { return std::fabs(x) > kLargestCoordinate; })) {
      fail(SOBB_ERROR_TOO_LARGE, "%s: vertex %zu, turned, is beyond 2^60", source.c_str(), i / 3);
    }
  }
  for (sobb_view& view : scene.views) view = turn.view(view);
  measure(scene, progress, 1);
}

}  // namespace sobb
