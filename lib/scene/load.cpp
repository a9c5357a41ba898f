// SPDX-License-Identifier: Apache-2.0
// See load.h.
#include "scene/load.h"

#include <string_view>
#include <utility>

#include "base/error.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/gltf.h"
#include "scene/input/read_file.h"
#include "scene/oblique_turn.h"
#include "scene/scene_writer.h"
#include "scene/subdivision/loop_subdivision.h"
#include "scene/text/obj.h"
#include "scene/text/off.h"
#include "scene/text/ply.h"
#include "scene/text/stl.h"
#include "scene/views.h"

namespace sobb {
namespace {

struct PathParts {
  std::string folder;  // with its slash
  std::string stem;
  std::string ending;  // in lower case, without its dot
};

PathParts split_path(const std::string& path) {
  PathParts parts;
  const size_t name = path.rfind('/') == std::string::npos ? 0 : path.rfind('/') + 1;
  const size_t dot = path.rfind('.');
  parts.folder = path.substr(0, name);
  if (dot == std::string::npos || dot < name) {
    parts.stem = path.substr(name);
    return parts;
  }
  parts.stem = path.substr(name, dot - name);
  for (const char c : path.substr(dot + 1)) {
    parts.ending += c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  }
  return parts;
}

using TextFormat = void (*)(std::string_view bytes, const char* name, SceneWriter& writer);

TextFormat text_format(const std::string& ending) {
  if (ending == "obj") return read_obj;
  if (ending == "ply") return read_ply;
  if (ending == "stl") return read_stl;
  if (ending == "off") return read_off;
  return nullptr;
}

bool is_known(const std::string& ending) {
  return ending == "gltf" || ending == "glb" || text_format(ending) != nullptr;
}

void load_builtin(const std::string& source, const char* views_path, uint64_t memory_limit,
                  Progress* progress, Scene& scene) {
  const BuiltinName name = parse_builtin(source);
  SceneWriter writer(source, memory_limit, scene, progress);
  std::vector<sobb_view> views = make_builtin(name, writer);
  writer.finish();
  if (views_path != nullptr) scene.views = read_views(views_path, name.scene, writer);
  for (sobb_view& view : scene.views) view = turn_of(name).view(view);
  if (scene.views.empty()) scene.views = std::move(views);
}

void load_file(const std::string& path, const char* views_path, uint64_t memory_limit,
               Progress* progress, Scene& scene) {
  const PathParts parts = split_path(path);
  const TextFormat format = text_format(parts.ending);
  if (!is_known(parts.ending)) {
    fail(SOBB_ERROR_SCENE_FORMAT,
         "%s: unknown ending '%s'; known are .gltf, .glb, .obj, .ply, .stl, .off, and builtin:NAME",
         path.c_str(), parts.ending.c_str());
  }
  SceneWriter writer(path, memory_limit, scene, progress);
  std::vector<GltfCamera> cameras;
  {
    const FileBytes file = read_file(path, writer);
    writer.hold(file.size);
    if (format == nullptr) {
      cameras = read_gltf(file.view(), path, writer);
    } else {
      format(file.view(), path.c_str(), writer);
    }
  }
  writer.finish();

  if (views_path != nullptr) scene.views = read_views(views_path, parts.stem, writer);
  const std::string beside = parts.folder + "cameras.json";
  if (scene.views.empty() && file_exists(beside)) {
    scene.views = read_views(beside, parts.stem, writer);
  }
  if (scene.views.empty()) scene.views = camera_views(cameras, half_diagonal(scene));
  if (!scene.views.empty()) return;
  scene.views.push_back(default_view(scene));
  scene.default_view = true;
}

// Where the suffix that begins with `mark` is; npos in a path that is meant as it stands.
size_t find_suffix(const std::string& source, char mark) {
  const size_t at = source.rfind(mark);
  if (is_builtin(source)) return at;
  const size_t slash = source.rfind('/');
  const bool in_folder = at != std::string::npos && slash != std::string::npos && at < slash;
  if (in_folder || is_known(split_path(source).ending) || file_exists(source)) {
    return std::string::npos;
  }
  return at;
}

// SOURCE[^TIMES][@DEGREES]
struct SourceParts {
  std::string scene;
  unsigned subdivisions = 0;
  std::string turn;  // with its '@', or nothing
};

SourceParts split_source(const std::string& source) {
  SourceParts parts;
  const size_t turn = find_suffix(source, '@');
  parts.scene = source.substr(0, turn);
  if (turn != std::string::npos) parts.turn = source.substr(turn);
  const size_t times = find_suffix(parts.scene, '^');
  if (times == std::string::npos) return parts;
  parts.subdivisions = parse_subdivisions(source, std::string_view(parts.scene).substr(times + 1));
  parts.scene.resize(times);
  return parts;
}

// Subdividing takes most of the time.
constexpr double kLoadedShare = 0.2;

}  // namespace

Scene load_scene(const std::string& source, const char* views_path, uint64_t memory_limit,
                 Progress* progress) {
  const SourceParts parts = split_source(source);
  const bool subdivided = parts.subdivisions > 0;
  if (subdivided && progress != nullptr) progress->set_part(0, kLoadedShare);
  Scene scene;
  if (is_builtin(source)) {
    load_builtin(parts.scene + parts.turn, views_path, memory_limit, progress, scene);
  } else {
    const double degrees = parts.turn.empty() ? 0 : parse_degrees(source, parts.turn.substr(1));
    load_file(parts.scene, views_path, memory_limit, progress, scene);
    if (degrees != 0) turn_scene(source, degrees, scene, progress);
  }
  if (subdivided && progress != nullptr) progress->set_part(kLoadedShare, 1);
  if (subdivided) subdivide_scene(source, parts.subdivisions, memory_limit, scene, progress);
  return scene;
}

}  // namespace sobb
