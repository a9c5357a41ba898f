// SPDX-License-Identifier: Apache-2.0
// Implements the C interface of capi/include/sobb/scene.h.
#include "sobb/scene.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <utility>

#include "../guard.h"
#include "scene/load.h"
#include "scene/model/notes.h"

struct sobb_scene {
  explicit sobb_scene(sobb::Scene loaded) : scene(std::move(loaded)) {}

  const sobb::Scene scene;
  std::atomic<uint64_t> references{1};
};

namespace {

// Returns element `index` of one of the scene's arrays. Error: INVALID_ARGUMENT where there is
// none.
template <class Element>
const Element& element(const std::vector<Element>& array, uint64_t index, const char* what) {
  if (index >= array.size()) {
    sobb::fail(SOBB_ERROR_INVALID_ARGUMENT, "%s %llu of %zu", what,
               static_cast<unsigned long long>(index), array.size());
  }
  return array[size_t(index)];
}

sobb::Vec3 read_origin(const double* xyz) {
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(xyz[k])) {
      sobb::fail(SOBB_ERROR_INVALID_ARGUMENT, "sobb_scene_options: origin[%d] is %g", k, xyz[k]);
    }
  }
  return {xyz[0], xyz[1], xyz[2]};
}

}  // namespace

extern "C" {

sobb_status sobb_scene_load(const char* source, const sobb_scene_options* options,
                            sobb_scene** out) {
  return sobb::guard([&] {
    sobb::require(source, "source");
    sobb::require(out, "out");
    const sobb_scene_options known = sobb::read_options(options, "sobb_scene_options");
    if (known.reserved != 0) {
      sobb::fail(SOBB_ERROR_INVALID_ARGUMENT, "sobb_scene_options: reserved is not zero");
    }
    sobb::Progress progress(known.progress, known.progress_user, "loading");
    sobb::Scene scene = sobb::load_scene(source, known.views_path, known.memory_limit, &progress,
                                         read_origin(known.origin));
    *out = std::make_unique<sobb_scene>(std::move(scene)).release();
  });
}

sobb_scene* sobb_scene_retain(sobb_scene* scene) {
  if (scene != nullptr) scene->references.fetch_add(1, std::memory_order_relaxed);
  return scene;
}

void sobb_scene_release(sobb_scene* scene) {
  if (scene == nullptr) return;
  if (scene->references.fetch_sub(1, std::memory_order_acq_rel) == 1) delete scene;
}

sobb_status sobb_scene_get_info(const sobb_scene* scene, sobb_scene_info* info) {
  return sobb::guard([&] {
    sobb::require(scene, "scene");
    const sobb::Scene& from = scene->scene;
    sobb_scene_info known{};
    known.default_view = from.default_view ? 1 : 0;
    known.vertex_count = from.vertices.size() / 3;
    known.triangle_count = from.indices.size() / 3;
    known.degenerate_count = from.degenerate_count;
    known.mesh_count = from.meshes.size();
    known.view_count = from.views.size();
    known.note_count = from.notes.size();
    std::copy(from.bounds_min.begin(), from.bounds_min.end(), known.bounds_min);
    std::copy(from.bounds_max.begin(), from.bounds_max.end(), known.bounds_max);
    sobb::write_info(known, info, "sobb_scene_info");
  });
}

sobb_status sobb_scene_get_note(const sobb_scene* scene, uint64_t index, sobb_scene_note* note) {
  return sobb::guard([&] {
    sobb::require(scene, "scene");
    const sobb::SceneNote& from = element(scene->scene.notes, index, "note");
    sobb_scene_note known{};
    known.cause = from.cause;
    known.count = from.count;
    known.message = from.first.c_str();
    sobb::write_info(known, note, "sobb_scene_note");
  });
}

const char* sobb_note_cause_name(uint32_t cause) { return sobb::note_cause_name(cause); }

sobb_status sobb_scene_triangles(const sobb_scene* scene, sobb_triangles* triangles) {
  return sobb::guard([&] {
    sobb::require(scene, "scene");
    sobb_triangles known{};
    known.vertices = scene->scene.vertices.data();
    known.vertex_count = scene->scene.vertices.size() / 3;
    known.vertex_stride = 3 * sizeof(float);
    known.indices = scene->scene.indices.data();
    known.triangle_count = scene->scene.indices.size() / 3;
    sobb::write_info(known, triangles, "sobb_triangles");
  });
}

sobb_status sobb_scene_mesh(const sobb_scene* scene, uint64_t index, sobb_mesh* mesh) {
  return sobb::guard([&] {
    sobb::require(scene, "scene");
    sobb::require(mesh, "mesh");
    const sobb::SceneMesh& from = element(scene->scene.meshes, index, "mesh");
    *mesh = {from.name.c_str(), from.first_triangle, from.triangle_count};
  });
}

sobb_status sobb_scene_view(const sobb_scene* scene, uint64_t index, sobb_view* view) {
  return sobb::guard([&] {
    sobb::require(scene, "scene");
    sobb::require(view, "view");
    *view = element(scene->scene.views, index, "view");
  });
}

}  // extern "C"
