// SPDX-License-Identifier: Apache-2.0
// See views.h.
#include "scene/views.h"

#include <array>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "scene/input/json.h"
#include "scene/input/read_file.h"

namespace sobb {
namespace {

using nlohmann::json;
using Vector = std::array<double, 3>;

bool finite_as_float(double x) { return std::isfinite(float(x)); }

// Whether a picture can be made: an eye off its target, an up across the direction, an angle.
bool is_possible(const sobb_view& view) {
  Vector d{};
  for (int k = 0; k < 3; ++k) d[k] = double(view.target[k]) - double(view.eye[k]);
  const float* up = view.up;
  const double across[3] = {d[1] * up[2] - d[2] * up[1], d[2] * up[0] - d[0] * up[2],
                            d[0] * up[1] - d[1] * up[0]};
  bool finite = std::isfinite(view.vfov_degrees);
  for (int k = 0; k < 3; ++k) {
    finite = finite && std::isfinite(view.eye[k]) && std::isfinite(view.target[k]) &&
             std::isfinite(up[k]);
  }
  return finite && (across[0] != 0 || across[1] != 0 || across[2] != 0) && view.vfov_degrees > 0 &&
         view.vfov_degrees < 180;
}

class ViewsReader {
 public:
  ViewsReader(const std::string& path, SceneWriter& writer) : path_(path), writer_(writer) {}

  std::vector<sobb_view> run(std::string_view text, std::string_view stem) const {
    const json document = parse_json(text, path_, writer_);
    if (!document.is_object()) wrong("the document", "is not an object");
    std::vector<sobb_view> views;
    const auto found = document.find(stem);
    if (found == document.end()) return views;
    if (!found->is_array()) wrong(std::string(stem), "is not an array of views");
    for (const json& given : *found) {
      views.push_back(view(given, std::string(stem) + "[" + std::to_string(views.size()) + "]"));
    }
    return views;
  }

 private:
  [[noreturn]] void wrong(const std::string& place, const char* what) const {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: %s %s", path_.c_str(), place.c_str(), what);
  }

  void read_vector(const json& given, const char* key, const std::string& place, float* out) const {
    const auto found = given.find(key);
    if (found == given.end() || !found->is_array() || found->size() != 3) {
      wrong(place + "." + key, "is not an array of three numbers");
    }
    for (size_t k = 0; k < 3; ++k) {
      const json& number = (*found)[k];
      if (!number.is_number() || !finite_as_float(number.get<double>())) {
        wrong(place + "." + key, "is not an array of three numbers");
      }
      out[k] = float(number.get<double>());
    }
  }

  sobb_view view(const json& given, const std::string& place) const {
    if (!given.is_object()) wrong(place, "is not an object");
    sobb_view result{};
    read_vector(given, "eye", place, result.eye);
    read_vector(given, "target", place, result.target);
    read_vector(given, "up", place, result.up);
    const auto angle = given.find("vfov_degrees");
    if (angle == given.end() || !angle->is_number()) {
      wrong(place + ".vfov_degrees", "is not a number");
    }
    result.vfov_degrees = float(angle->get<double>());
    if (!is_possible(result)) {
      wrong(place, "sees nothing: eye at target, up along the direction, or vfov not in (0, 180)");
    }
    return result;
  }

  const std::string& path_;
  SceneWriter& writer_;
};

Vector box_centre(const Scene& scene) {
  Vector centre{};
  for (size_t k = 0; k < 3; ++k) {
    centre[k] = (double(scene.bounds_min[k]) + double(scene.bounds_max[k])) / 2;
  }
  return centre;
}

}  // namespace

std::vector<sobb_view> parse_views(std::string_view text, const std::string& path,
                                   std::string_view stem, SceneWriter& writer) {
  return ViewsReader(path, writer).run(text, stem);
}

std::vector<sobb_view> read_views(const std::string& path, std::string_view stem,
                                  SceneWriter& writer) {
  const FileBytes bytes = read_file(path, writer);
  writer.hold(bytes.size);
  return parse_views(bytes.view(), path, stem, writer);
}

std::vector<sobb_view> camera_views(const std::vector<GltfCamera>& cameras, double distance) {
  std::vector<sobb_view> views;
  for (const GltfCamera& camera : cameras) {
    const Vector eye = camera.transform.translation;
    const Vector forward = camera.transform.vector({0, 0, -1});
    const Vector up = camera.transform.vector({0, 1, 0});
    const auto length = [](const Vector& v) {
      return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    };
    sobb_view view{};
    for (size_t k = 0; k < 3; ++k) {
      view.eye[k] = float(eye[k]);
      view.target[k] = float(eye[k] + distance * forward[k] / length(forward));
      view.up[k] = float(up[k] / length(up));
    }
    view.vfov_degrees = float(camera.vfov * 180 / std::numbers::pi);
    if (is_possible(view)) views.push_back(view);
  }
  return views;
}

double half_diagonal(const Scene& scene) {
  double square = 0;
  for (size_t k = 0; k < 3; ++k) {
    const double half = (double(scene.bounds_max[k]) - double(scene.bounds_min[k])) / 2;
    square += half * half;
  }
  return std::sqrt(square);
}

sobb_view default_view(const Scene& scene) {
  constexpr double kDirection[3] = {0.48, 0.36, 0.8};
  const Vector centre = box_centre(scene);
  // A scene that is one point is looked at from a distance, too.
  const double half = half_diagonal(scene) > 0 ? half_diagonal(scene) : 1;
  sobb_view view{};
  for (size_t k = 0; k < 3; ++k) {
    view.eye[k] = float(centre[k] + 2.2 * half * kDirection[k]);
    view.target[k] = float(centre[k]);
  }
  view.up[1] = 1;
  view.vfov_degrees = 50;
  return view;
}

}  // namespace sobb
