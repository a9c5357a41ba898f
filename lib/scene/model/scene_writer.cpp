// SPDX-License-Identifier: Apache-2.0
// See scene_writer.h.
#include "scene/model/scene_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "base/error.h"
#include "scene/model/measure.h"
#include "scene/model/polygon.h"
#include "scene/model/utf8.h"

namespace sobb {
namespace {

constexpr uint64_t kMaxVertices = uint64_t(1) << 32;

// Progress is reported every so many vertices: some milliseconds.
constexpr uint64_t kReportEvery = 1 << 16;

// The share of progress that reading takes; the rest is measuring what was read.
constexpr double kReadShare = 0.9;

// Clipping ears looks at 165 corners per corner in the worst polygons measured, so long as they do
// not cross themselves. One that does is given up at this limit. It is cancelled between turns.
constexpr uint64_t kVisitsPerCorner = 1024;
constexpr uint64_t kVisitsPerTurn = 1 << 12;

// What a mesh takes in an array that doubles: the old array lives until it is moved.
constexpr uint64_t kMeshBytes = 3 * sizeof(SceneMesh);

// The size to which a full array of triples grows: half as much again, so that growing stays cheap.
uint64_t grown_size(uint64_t size, uint64_t max_triples) {
  return std::min(3 * max_triples, std::max<uint64_t>(3 * 64, size + size / 2 + 3));
}

std::string unusable_vertex(float x, float y, float z) {
  const bool finite = std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
  char text[100];
  std::snprintf(text, sizeof text, "vertex (%g, %g, %g) is %s", double(x), double(y), double(z),
                finite ? "beyond 2^60" : "not finite");
  return text;
}

}  // namespace

SceneWriter::SceneWriter(std::string name, uint64_t memory_limit, Scene& scene, Progress* progress)
    : name_(std::move(name)),
      memory_limit_(memory_limit),
      scene_(scene),
      progress_(progress),
      until_report_(kReportEvery) {}

void SceneWriter::hold(uint64_t bytes) {
  check_room(bytes);
  held_ += bytes;
}

void SceneWriter::check_room(uint64_t bytes) const {
  if (bytes > memory_left()) refuse_memory(bytes);
}

void SceneWriter::reach(double fraction) {
  reached_ = fraction;
  report();
}

void SceneWriter::report() {
  until_report_ = kReportEvery;
  if (progress_ != nullptr) progress_->check(0, kReadShare, reached_);
}

uint64_t SceneWriter::memory_left() const {
  if (memory_limit_ == 0) return std::numeric_limits<uint64_t>::max();
  const uint64_t taken = held_ + scene_.vertices.capacity() * sizeof(float) +
                         scene_.indices.capacity() * sizeof(uint32_t);
  return taken < memory_limit_ ? memory_limit_ - taken : 0;
}

void SceneWriter::refuse_memory(uint64_t bytes) const {
  fail(SOBB_ERROR_MEMORY_LIMIT, "%s: needs %llu bytes more, %llu of the limit of %llu are left",
       name_.c_str(), static_cast<unsigned long long>(bytes),
       static_cast<unsigned long long>(memory_left()),
       static_cast<unsigned long long>(memory_limit_));
}

void SceneWriter::begin_mesh(std::string name) {
  end_mesh();
  work(1);
  name = valid_utf8(std::move(name));
  hold(kMeshBytes + name.capacity());
  scene_.meshes.push_back({std::move(name), scene_.indices.size() / 3, 0});
}

void SceneWriter::end_mesh() {
  const uint64_t triangles = scene_.indices.size() / 3;
  if (scene_.meshes.empty()) {
    // Triangles that come before any mesh is begun are a mesh too.
    if (triangles > 0) scene_.meshes.push_back({"", 0, triangles});
    return;
  }
  SceneMesh& mesh = scene_.meshes.back();
  mesh.triangle_count = triangles - mesh.first_triangle;
  if (mesh.triangle_count > 0) return;
  held_ -= kMeshBytes + mesh.name.capacity();
  scene_.meshes.pop_back();
}

void SceneWriter::note_unusable(float x, float y, float z, const std::string& place) {
  ++unusable_;
  note(SOBB_NOTE_UNUSED_VERTEX, [&] { return place + ": " + unusable_vertex(x, y, z); });
}

bool SceneWriter::is_usable(uint64_t vertex) const {
  const float* xyz = &scene_.vertices[3 * vertex];
  return in_range(xyz[0]) && in_range(xyz[1]) && in_range(xyz[2]);
}

bool SceneWriter::are_usable(std::span<const uint64_t> corners) const {
  return std::all_of(corners.begin(), corners.end(), [this](uint64_t corner) {
    return corner >= vertex_count() || is_usable(corner);
  });
}

// What reads a scene need not look whether a vertex is in range.
void SceneWriter::clear_unusable() {
  for (uint64_t vertex = 0; unusable_ > 0 && vertex < vertex_count(); ++vertex) {
    if (!is_usable(vertex)) std::fill_n(&scene_.vertices[3 * vertex], 3, 0.0F);
  }
}

std::string SceneWriter::short_face(size_t corners, const std::string& place) {
  return place + ": a face of " + std::to_string(corners) + (corners == 1 ? " corner" : " corners");
}

void SceneWriter::refuse_polygon(std::span<const uint64_t> corners,
                                 const std::string& place) const {
  size_t i = 0;
  while (corners[i] < vertex_count() && is_usable(corners[i])) ++i;
  if (corners[i] < vertex_count()) {
    const float* xyz = &scene_.vertices[3 * corners[i]];
    const bool finite = std::all_of(xyz, xyz + 3, [](float x) { return std::isfinite(x); });
    fail(finite ? SOBB_ERROR_TOO_LARGE : SOBB_ERROR_NOT_FINITE, "%s: %s: corner %zu: %s",
         name_.c_str(), place.c_str(), i, unusable_vertex(xyz[0], xyz[1], xyz[2]).c_str());
  }
  fail(SOBB_ERROR_INDEX, "%s: %s: corner %zu names vertex %llu of %llu", name_.c_str(),
       place.c_str(), i, static_cast<unsigned long long>(corners[i]),
       static_cast<unsigned long long>(vertex_count()));
}

void SceneWriter::add_larger_polygon(std::span<const uint64_t> corners) {
  points_.clear();
  if (points_.capacity() < corners.size()) {
    const uint64_t old = points_.capacity() * sizeof(Vec3);
    reserve(points_, std::max(corners.size(), 2 * points_.capacity()));
    held_ += points_.capacity() * sizeof(Vec3) - old;
  }
  for (const uint64_t corner : corners) points_.push_back(widen(&scene_.vertices[3 * corner]));
  if (fan_covers(points_)) {
    for (size_t i = 2; i < corners.size(); ++i)
      add_triangle(corners[0], corners[i - 1], corners[i]);
  } else if (corners.size() == 4) {
    // The fan about the second corner is the only other way.
    add_triangle(corners[1], corners[2], corners[3]);
    add_triangle(corners[1], corners[3], corners[0]);
  } else {
    add_ears(corners);
  }
}

void SceneWriter::add_ears(std::span<const uint64_t> corners) {
  const uint64_t bytes = ear_clipping_bytes(corners.size());
  hold(bytes);
  uint64_t turns = corners.size() * kVisitsPerCorner / kVisitsPerTurn + 1;
  const std::vector<uint32_t> triangles = clip_ears(points_, [&]() -> size_t {
    work(kVisitsPerTurn);
    return turns-- > 0 ? kVisitsPerTurn : 0;
  });
  for (size_t i = 0; i < triangles.size(); i += 3) {
    add_triangle(corners[triangles[i]], corners[triangles[i + 1]], corners[triangles[i + 2]]);
  }
  held_ -= bytes;
}

// Makes room for `size` elements where the limit allows it. The old elements live until they are
// moved, so all new ones come on top of them.
template <class T>
void SceneWriter::reserve(std::vector<T>& array, uint64_t size) {
  check_room(size * sizeof(T));
  array.reserve(size);
}

// The capacity of a reader's array counts as held; memory_left() counts those of the scene's
// itself.
void SceneWriter::grow_corners(std::vector<uint64_t>& corners) {
  const uint64_t old = corners.capacity() * sizeof(uint64_t);
  reserve(corners, std::max<uint64_t>(64, 2 * corners.size()));
  held_ += corners.capacity() * sizeof(uint64_t) - old;
}

void SceneWriter::grow_vertices() {
  const uint64_t size = scene_.vertices.size();
  if (size / 3 >= kMaxVertices) {
    fail(SOBB_ERROR_TOO_LARGE, "%s: more than 2^32 vertices", name_.c_str());
  }
  reserve(scene_.vertices, grown_size(size, kMaxVertices));
}

void SceneWriter::grow_indices() {
  const uint64_t size = scene_.indices.size();
  if (size / 3 >= SOBB_MAX_TRIANGLES) {
    fail(SOBB_ERROR_TOO_LARGE, "%s: more than 2^32 - 3 triangles", name_.c_str());
  }
  reserve(scene_.indices, grown_size(size, SOBB_MAX_TRIANGLES));
}

void SceneWriter::check_counts(uint64_t vertices, uint64_t triangles) const {
  if (vertices > kMaxVertices - vertex_count() ||
      triangles > SOBB_MAX_TRIANGLES - scene_.indices.size() / 3) {
    fail(SOBB_ERROR_TOO_LARGE, "%s: more than 2^32 vertices or 2^32 - 3 triangles", name_.c_str());
  }
}

void SceneWriter::expect(uint64_t vertices, uint64_t triangles) {
  check_counts(vertices, triangles);
  // A file may declare its meshes one by one: growing by half keeps each from moving the arrays.
  const auto enough = [](uint64_t size, uint64_t more) {
    return size == 0 ? 3 * more : std::max(size + 3 * more, size + size / 2);
  };
  if (scene_.vertices.capacity() - scene_.vertices.size() < 3 * vertices) {
    reserve(scene_.vertices, enough(scene_.vertices.size(), vertices));
  }
  if (scene_.indices.capacity() - scene_.indices.size() < 3 * triangles) {
    reserve(scene_.indices, enough(scene_.indices.size(), triangles));
  }
}

// What was passed over is the likely cause.
void SceneWriter::refuse_empty() const {
  std::string why;
  for (const SceneNote& note : scene_.notes) {
    why += "; passed over " + std::to_string(note.count) + " (" + note_cause_name(note.cause) +
           "): " + note.first;
  }
  fail(SOBB_ERROR_EMPTY, "%s: no triangles%s", name_.c_str(), why.c_str());
}

void SceneWriter::finish() {
  end_mesh();
  if (scene_.indices.empty()) refuse_empty();
  clear_unusable();
  measure(scene_, progress_, kReadShare);
}

}  // namespace sobb
