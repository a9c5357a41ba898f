// SPDX-License-Identifier: Apache-2.0
// See views_file.h.
#include "scene/views/views_file.h"

#include <cmath>

#include "scene/input/json.h"
#include "scene/input/read_file.h"
#include "scene/views/view.h"

namespace sobb {
namespace {

using nlohmann::json;

class ViewsReader {
 public:
  ViewsReader(const std::string& path, SceneWriter& writer) : path_(path), writer_(writer) {}

  std::vector<sobb_view> read(std::string_view text, const std::string& stem) const {
    const json document = parse_json(text, path_, writer_);
    if (!document.is_object()) refuse_json(path_, "the document", "is not an object");
    std::vector<sobb_view> views;
    const auto found = document.find(stem);
    if (found == document.end()) return views;
    if (!found->is_array()) refuse_json(path_, stem, "is not an array of views");
    for (const json& given : *found) {
      views.push_back(view(given, stem + "[" + std::to_string(views.size()) + "]"));
    }
    return views;
  }

 private:
  sobb_view view(const json& given, const std::string& place) const {
    if (!given.is_object()) refuse_json(path_, place, "is not an object");
    sobb_view result{};
    read_vector(given, "eye", place, writer_.origin(), result.eye);
    read_vector(given, "target", place, writer_.origin(), result.target);
    read_vector(given, "up", place, {}, result.up);
    const auto angle = given.find("vfov_degrees");
    if (angle == given.end() || !angle->is_number()) {
      refuse_json(path_, place + ".vfov_degrees", "is not a number");
    }
    result.vfov_degrees = float(angle->get<double>());
    if (!is_possible(result)) {
      refuse_json(path_, place,
                  "sees nothing: eye at target, up along the direction, or vfov not in (0, 180)");
    }
    return result;
  }

  void read_vector(const json& given, const char* key, const std::string& place, Vec3 origin,
                   float* out) const {
    const double from[3] = {origin.x, origin.y, origin.z};
    const auto found = given.find(key);
    bool good = found != given.end() && found->is_array() && found->size() == 3;
    for (size_t k = 0; good && k < 3; ++k) {
      const json& number = (*found)[k];
      if (number.is_number()) out[k] = float(number.get<double>() - from[k]);
      good = number.is_number() && std::isfinite(out[k]);
    }
    if (!good) refuse_json(path_, place + "." + key, "is not an array of three numbers");
  }

  const std::string& path_;
  SceneWriter& writer_;
};

}  // namespace

std::vector<sobb_view> parse_views(std::string_view text, const std::string& path,
                                   std::string_view stem, SceneWriter& writer) {
  return ViewsReader(path, writer).read(text, std::string(stem));
}

std::vector<sobb_view> read_views(const std::string& path, std::string_view stem,
                                  SceneWriter& writer) {
  const FileBytes bytes = read_file(path, writer);
  writer.hold(bytes.size);
  return parse_views(bytes.view(), path, stem, writer);
}

}  // namespace sobb
