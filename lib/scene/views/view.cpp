// SPDX-License-Identifier: Apache-2.0
// See view.h.
#include "scene/views/view.h"

#include <cmath>
#include <numbers>

#include "scene/model/measure.h"

namespace sobb {

bool is_possible(const sobb_view& view) {
  bool finite = std::isfinite(view.vfov_degrees);
  for (int k = 0; k < 3; ++k) {
    finite = finite && std::isfinite(view.eye[k]) && std::isfinite(view.target[k]) &&
             std::isfinite(view.up[k]);
  }
  const Vec3 across = cross(widen(view.target) - widen(view.eye), widen(view.up));
  return finite && (across.x != 0 || across.y != 0 || across.z != 0) && view.vfov_degrees > 0 &&
         view.vfov_degrees < 180;
}

std::vector<sobb_view> camera_views(const std::vector<SceneCamera>& cameras, double distance) {
  std::vector<sobb_view> views;
  for (const SceneCamera& camera : cameras) {
    sobb_view view{};
    narrow(camera.eye, view.eye);
    narrow(camera.eye + distance * camera.forward / length(camera.forward), view.target);
    narrow(camera.up / length(camera.up), view.up);
    view.vfov_degrees = float(camera.vfov_radians * 180 / std::numbers::pi);
    if (is_possible(view)) views.push_back(view);
  }
  return views;
}

sobb_view default_view(const Scene& scene) {
  const Vec3 centre = box_centre(scene);
  // A scene that is one point has no diagonal, but is looked at from a distance too.
  const double half = half_diagonal(scene) > 0 ? half_diagonal(scene) : 1;
  sobb_view view{};
  narrow(centre + 2.2 * half * Vec3{0.48, 0.36, 0.8}, view.eye);
  narrow(centre, view.target);
  view.up[1] = 1;
  view.vfov_degrees = 50;
  return view;
}

}  // namespace sobb
