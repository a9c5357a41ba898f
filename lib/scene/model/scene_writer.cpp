// SPDX-License-Identifier: Apache-2.0
// See scene_writer.h.
#include "scene/model/scene_writer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "scene/model/measure.h"
#include "scene/model/utf8.h"

namespace sobb {
namespace {

constexpr uint64_t kMaxVertices = uint64_t(1) << 32;

// Progress is reported every so many vertices: some milliseconds.
constexpr uint64_t kReportEvery = 1 << 16;

// The share of progress that reading takes; the rest is measuring what was read.
constexpr double kReadShare = 0.9;

// What a mesh takes in an array that doubles: the old array lives until it is moved.
constexpr uint64_t kMeshBytes = 3 * sizeof(SceneMesh);

// The size to which a full array of triples grows: half as much again, so that growing stays cheap.
uint64_t grown_size(uint64_t size, uint64_t max_triples) {
  return std::min(3 * max_triples, std::max<uint64_t>(3 * 64, size + size / 2 + 3));
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

void SceneWriter::refuse_vertex(float x, float y, float z, const std::string& place) const {
  const bool finite = std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
  fail(finite ? SOBB_ERROR_TOO_LARGE : SOBB_ERROR_NOT_FINITE, "%s: %s: vertex (%g, %g, %g) is %s",
       name_.c_str(), place.c_str(), double(x), double(y), double(z),
       finite ? "beyond 2^60" : "not finite");
}

void SceneWriter::refuse_polygon(std::span<const uint64_t> corners,
                                 const std::string& place) const {
  if (corners.size() < 3) {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: %s: a face of %zu corners", name_.c_str(), place.c_str(),
         corners.size());
  }
  size_t i = 0;
  while (corners[i] < vertex_count()) ++i;
  fail(SOBB_ERROR_INDEX, "%s: %s: corner %zu names vertex %llu of %llu", name_.c_str(),
       place.c_str(), i, static_cast<unsigned long long>(corners[i]),
       static_cast<unsigned long long>(vertex_count()));
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

void SceneWriter::finish() {
  end_mesh();
  if (scene_.indices.empty()) fail(SOBB_ERROR_EMPTY, "%s: no triangles", name_.c_str());
  measure(scene_, progress_, kReadShare);
}

}  // namespace sobb
