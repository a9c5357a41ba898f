// SPDX-License-Identifier: Apache-2.0
// See builtin.h.
#include "scene/builtin/builtin.h"

#include <charconv>

#include "base/error.h"
#include "scene/builtin/parts.h"
#include "scene/builtin/scenes.h"

namespace sobb {
namespace {

constexpr std::string_view kPrefix = "builtin:";
constexpr uint64_t kMostTriangles = 1'000'000'000;

struct BuiltinView {  // y is up
  Vec3 eye;
  Vec3 target;
  double vfov_degrees;
};

struct BuiltinScene {
  const char* name;
  void (*make)(PartsWriter& parts);
  Vec3 centre;
  std::vector<BuiltinView> views;
};

const std::vector<BuiltinScene>& scenes() {
  static const std::vector<BuiltinScene> all = {
      {"hairball", make_hairball, {0, 0, 0}, {{{1.4, 1.1, 2.2}, {0, 0, 0}, 45}}},
      {"wool", make_wool, {0, 0.8, 0}, {{{-2.3, 1.5, 1.6}, {0, 0.76, 0.3}, 38}}},
      {"pipes",
       make_pipes,
       {0, 0, 0},
       {{{3.9, 1.9, 4.2}, {0, -0.2, 0}, 42}, {{0.3, 0.4, 3}, {-0.2, 0, 0}, 60}}},
      {"foliage",
       make_foliage,
       {0, 1, 0},
       {{{11, 6, 15}, {0, 0.6, 0.5}, 42}, {{0.5, 1.1, 12.5}, {-0.5, 1.5, 0}, 55}}},
      {"city", make_city, {0, 1, 0}, {{{11, 6, 13}, {0, 0.5, 0.6}, 42}}},
      {"terrain",
       make_terrain,
       {0, 0, 0},
       {{{11, 6.5, 13}, {-0.3, -0.8, 0}, 42}, {{3, 3, 11}, {-0.5, 0.2, 0}, 50}}},
  };
  return all;
}

const BuiltinScene* find_scene(std::string_view name) {
  for (const BuiltinScene& scene : scenes()) {
    if (name == scene.name) return &scene;
  }
  return nullptr;
}

// Parses all of `text` as a number; false where it is none.
bool parse_count(std::string_view text, uint64_t& count) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

bool is_builtin(std::string_view source) { return source.starts_with(kPrefix); }

BuiltinName parse_builtin(const std::string& source) {
  BuiltinName result;
  std::string_view rest = std::string_view(source).substr(kPrefix.size());
  const size_t at = rest.find('@');
  if (at != std::string_view::npos) {
    result.degrees = parse_degrees(source, rest.substr(at + 1));
    rest = rest.substr(0, at);
  }
  const size_t colon = rest.find(':');
  if (colon != std::string_view::npos) {
    const bool number = parse_count(rest.substr(colon + 1), result.triangles);
    if (!number || result.triangles < kLeastTriangles || result.triangles > kMostTriangles) {
      fail(SOBB_ERROR_SCENE_SYNTAX,
           "%s: after the name comes a number of triangles from %llu to %llu", source.c_str(),
           static_cast<unsigned long long>(kLeastTriangles),
           static_cast<unsigned long long>(kMostTriangles));
    }
    rest = rest.substr(0, colon);
  }
  result.scene = rest;
  if (find_scene(rest) == nullptr) {
    std::string known;
    for (const BuiltinScene& scene : scenes()) {
      known += (known.empty() ? "" : ", ") + std::string(scene.name);
    }
    fail(SOBB_ERROR_SCENE_FORMAT, "%s: no such built-in scene; there are %s", source.c_str(),
         known.c_str());
  }
  return result;
}

ObliqueTurn turn_of(const BuiltinName& name, Vec3 origin) {
  return {name.degrees, find_scene(name.scene)->centre - origin};
}

std::vector<sobb_view> make_builtin(const BuiltinName& name, SceneWriter& writer) {
  const BuiltinScene& scene = *find_scene(name.scene);
  const ObliqueTurn turn = turn_of(name);
  writer.expect(0, name.triangles);
  writer.begin_mesh(name.scene);
  PartsWriter parts(writer, name.triangles, turn);
  scene.make(parts);

  std::vector<sobb_view> views;
  for (const BuiltinView& view : scene.views) {
    sobb_view& turned = views.emplace_back();
    narrow(turn.point(view.eye) - writer.origin(), turned.eye);
    narrow(turn.point(view.target) - writer.origin(), turned.target);
    narrow(turn.vector({0, 1, 0}), turned.up);
    turned.vfov_degrees = float(view.vfov_degrees);
  }
  return views;
}

}  // namespace sobb
