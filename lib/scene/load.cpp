// SPDX-License-Identifier: Apache-2.0
// See load.h.
#include "scene/load.h"

#include <utility>

#include "base/error.h"
#include "scene/builtin/builtin.h"
#include "scene/formats.h"
#include "scene/input/read_file.h"
#include "scene/model/measure.h"
#include "scene/model/oblique_turn.h"
#include "scene/model/scene_writer.h"
#include "scene/source_name.h"
#include "scene/subdivision/loop_subdivision.h"
#include "scene/views/view.h"
#include "scene/views/views_file.h"

namespace sobb {
namespace {

// The share of progress that loading takes before subdivision, which takes most of the time.
constexpr double kLoadedShare = 0.2;

void load_builtin(const std::string& source, const char* views_path, SceneWriter& writer,
                  Scene& scene) {
  const BuiltinName name = parse_builtin(source);
  std::vector<sobb_view> views = make_builtin(name, writer);
  writer.finish();
  if (views_path != nullptr) scene.views = read_views(views_path, name.scene, writer);
  for (sobb_view& view : scene.views) view = turn_of(name, writer.origin()).view(view);
  if (scene.views.empty()) scene.views = std::move(views);
}

// Other programs call files cameras.json too: what cannot be read as ours is no fault of the scene.
std::vector<sobb_view> views_beside(const std::string& path, const std::string& stem,
                                    SceneWriter& writer) {
  try {
    return read_views(path, stem, writer);
  } catch (const Error& error) {
    if (error.status == SOBB_ERROR_CANCELLED) throw;
    writer.note(SOBB_NOTE_VIEWS, [&error] { return std::string(error.what()); });
    return {};
  }
}

// Views are those of the first of these that has any: the file given, the file beside the scene,
// the scene's cameras; else the default one.
void find_views(const PathParts& path, const char* views_path, SceneWriter& writer, Scene& scene) {
  if (views_path != nullptr) scene.views = read_views(views_path, path.stem, writer);
  const std::string beside = path.folder + "cameras.json";
  if (scene.views.empty() && file_exists(beside)) {
    scene.views = views_beside(beside, path.stem, writer);
  }
  if (scene.views.empty()) scene.views = camera_views(writer.cameras(), half_diagonal(scene));
  if (!scene.views.empty()) return;
  scene.views.push_back(default_view(scene));
  scene.default_view = true;
}

void load_file(const std::string& path, const char* views_path, SceneWriter& writer, Scene& scene) {
  const PathParts parts = split_path(path);
  const FormatReader reader = find_format(parts.ending);
  if (reader == nullptr) {
    fail(SOBB_ERROR_SCENE_FORMAT, "%s: unknown ending '%s'; known are %s, and builtin:NAME",
         path.c_str(), parts.ending.c_str(), known_endings().c_str());
  }
  {
    const FileBytes file = read_file(path, writer);
    writer.hold(file.size);
    reader(file.view(), writer);
  }
  writer.finish();
  find_views(parts, views_path, writer, scene);
}

}  // namespace

Scene load_scene(const std::string& source, const char* views_path, uint64_t memory_limit,
                 Progress* progress, Vec3 origin) {
  const SourceName name = parse_source(source);
  const bool subdivided = name.subdivisions > 0;
  if (subdivided && progress != nullptr) progress->set_part(0, kLoadedShare);
  Scene scene;
  if (is_builtin(source)) {
    const std::string turned = name.scene + name.turn;
    SceneWriter writer(turned, memory_limit, scene, progress);
    writer.set_origin(origin);
    load_builtin(turned, views_path, writer, scene);
  } else {
    const double degrees = name.turn.empty() ? 0 : parse_degrees(source, name.turn.substr(1));
    SceneWriter writer(name.scene, memory_limit, scene, progress);
    writer.set_origin(origin);
    load_file(name.scene, views_path, writer, scene);
    if (degrees != 0) turn_scene(source, degrees, scene, progress);
  }
  if (subdivided && progress != nullptr) progress->set_part(kLoadedShare, 1);
  if (subdivided) subdivide_scene(source, name.subdivisions, memory_limit, scene, progress);
  return scene;
}

}  // namespace sobb
