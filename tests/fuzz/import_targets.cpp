// SPDX-License-Identifier: Apache-2.0
// The targets of the readers: each gives a scene whose every index is in range, or a status, within
// the memory allowed.
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "fuzz/heap_watch.h"
#include "fuzz/targets.h"
#include "scene/formats.h"
#include "scene/gltf/gltf.h"
#include "scene/model/measure.h"
#include "scene/text/obj.h"
#include "scene/text/off.h"
#include "scene/text/ply.h"
#include "scene/text/stl.h"
#include "scene/views/view.h"
#include "scene/views/views_file.h"

namespace sobb::fuzz {
namespace {

constexpr uint64_t kMemoryLimit = 8 << 20;
constexpr int64_t kBookkeeping = 1 << 18;  // for what holds no part of the file

std::string_view text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

bool may_refuse_with(sobb_status status) {
  switch (status) {
    case SOBB_ERROR_EMPTY:
    case SOBB_ERROR_INDEX:
    case SOBB_ERROR_NOT_FINITE:
    case SOBB_ERROR_TOO_LARGE:
    case SOBB_ERROR_MEMORY_LIMIT:
    case SOBB_ERROR_SCENE_SYNTAX:
    case SOBB_ERROR_SCENE_UNSUPPORTED:
    case SOBB_ERROR_SCENE_REFERENCE:
      return true;
    default:
      return false;
  }
}

void check_views(const std::vector<sobb_view>& views) {
  for (const sobb_view& view : views) {
    for (int axis = 0; axis < 3; ++axis) {
      expect(std::isfinite(view.eye[axis]) && std::isfinite(view.target[axis]) &&
                 std::isfinite(view.up[axis]),
             "a view is somewhere");
    }
    expect(view.vfov_degrees > 0 && view.vfov_degrees < 180, "a view has an angle");
  }
}

void check_scene(const Scene& scene) {
  expect(!scene.indices.empty() && scene.indices.size() % 3 == 0, "a scene has triangles");
  for (const uint32_t index : scene.indices) {
    expect(index < scene.vertices.size() / 3, "an index names a vertex");
  }
  for (const float x : scene.vertices) expect(std::fabs(x) <= 0x1p60f, "a vertex is in range");
  uint64_t next = 0;
  for (const SceneMesh& mesh : scene.meshes) {
    expect(mesh.first_triangle == next && mesh.triangle_count > 0, "meshes are in order");
    next += mesh.triangle_count;
  }
  expect(next == scene.indices.size() / 3, "meshes cover the scene");
  for (const SceneNote& note : scene.notes) {
    expect(note.count > 0 && !note.first.empty(), "a note says what was passed over");
  }
  check_views(scene.views);
}

// Runs body(scene, writer) under the limit of memory.
template <class Body>
void run_limited(const Body& body) {
  const HeapWatch heap;
  try {
    Scene scene;
    SceneWriter writer("no such folder/scene", kMemoryLimit, scene);  // nothing is beside it
    body(scene, writer);
  } catch (const Error& error) {
    expect(may_refuse_with(error.status), "a source is refused with a status of the scene's");
  }
  expect(heap.peak() <= static_cast<int64_t>(kMemoryLimit) + kBookkeeping,
         "reading stays within its memory limit");
}

void run_reader(FormatReader reader, std::string_view bytes) {
  run_limited([&](Scene& scene, SceneWriter& writer) {
    reader(bytes, writer);
    writer.finish();
    scene.views = camera_views(writer.cameras(), half_diagonal(scene));
    check_scene(scene);
  });
}

void append_word(std::string& to, uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) to += static_cast<char>(word >> shift);
}

void append_chunk(std::string& to, uint32_t type, std::string_view content) {
  append_word(to, static_cast<uint32_t>(content.size()));
  append_word(to, type);
  to += content;
}

}  // namespace

void obj(Bytes bytes) { run_reader(read_obj, text_of(bytes)); }
void ply(Bytes bytes) { run_reader(read_ply, text_of(bytes)); }
void stl(Bytes bytes) { run_reader(read_stl, text_of(bytes)); }
void off(Bytes bytes) { run_reader(read_off, text_of(bytes)); }
void gltf(Bytes bytes) { run_reader(read_gltf, text_of(bytes)); }

// Reads a GLB as it is. Other bytes become one, whose JSON chunk is the text up to the first zero
// and whose binary chunk is the rest.
void glb(Bytes bytes) {
  const std::string_view text = text_of(bytes);
  if (text.starts_with("glTF")) {
    run_reader(read_gltf, text);
    return;
  }
  const size_t zero = std::min(text.find('\0'), text.size());
  std::string chunks;
  append_chunk(chunks, 0x4E4F534A, text.substr(0, zero));
  if (zero < text.size()) append_chunk(chunks, 0x004E4942, text.substr(zero + 1));
  std::string file = "glTF";
  append_word(file, 2);
  append_word(file, static_cast<uint32_t>(12 + chunks.size()));
  run_reader(read_gltf, file + chunks);
}

void views(Bytes bytes) {
  run_limited([&](Scene&, SceneWriter& writer) {
    check_views(parse_views(text_of(bytes), "cameras.json", "scene", writer));
  });
}

}  // namespace sobb::fuzz
