// SPDX-License-Identifier: Apache-2.0
// SceneWriter takes the triangles of a reader and checks them as they come, so that no reader
// repeats the checks.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "scene/model/notes.h"
#include "scene/model/scene.h"

namespace sobb {

// Fills a scene. `name` is the source, for messages. `memory_limit` (0 for none) bounds the bytes
// that the scene and its reader hold, and is checked before they are taken. `progress`, if any, is
// called every few milliseconds of whatever the reader does, and may cancel it.
//
// Every function that adds, works or reports may throw CANCELLED.
class SceneWriter {
 public:
  SceneWriter(std::string name, uint64_t memory_limit, Scene& scene, Progress* progress = nullptr);

  const std::string& name() const { return name_; }

  // The point that is subtracted from all vertices, cameras and views in double, before they are
  // rounded to float; zero unless it is set, before reading.
  void set_origin(Vec3 origin) { origin_ = origin; }
  Vec3 origin() const { return origin_; }
  bool has_origin() const { return origin_.x != 0 || origin_.y != 0 || origin_.z != 0; }

  // The reader holds `bytes` more of its own (the file, its buffers): they count against the limit.
  // Error MEMORY_LIMIT.
  void hold(uint64_t bytes);
  // Error MEMORY_LIMIT where there is no room for what the reader is to hold for a while.
  void check_room(uint64_t bytes) const;
  bool has_limit() const { return memory_limit_ != 0; }
  uint64_t memory_left() const;  // what the reader may yet hold; the largest number for no limit

  // The reader has come so far in its source, from 0 to 1.
  void reach(double fraction);
  // The reader did work that adds nothing, about as much as that many vertices are.
  void work(uint64_t vertices) {
    if (vertices >= until_report_) {
      report();
    } else {
      until_report_ -= vertices;
    }
  }

  // Starts a mesh, which the triangles that follow belong to. A mesh without triangles is dropped.
  void begin_mesh(std::string name);

  // Adds a vertex. `place` says where in the source it is, as in "line 12" or "mesh 3, vertex 7":
  // text, or, where making that for every vertex would cost too much, a function that makes it for
  // an error. It is rounded to float here. One that is then not finite or beyond 2^60 is kept until
  // finish(), but no polygon may use it. Error MEMORY_LIMIT.
  void add_vertex(double x, double y, double z, const char* place) {
    add_vertex(x, y, z, [place] { return std::string(place); });
  }
  template <std::invocable Place>
  void add_vertex(double wide_x, double wide_y, double wide_z, const Place& place) {
    const float x = static_cast<float>(wide_x - origin_.x);
    const float y = static_cast<float>(wide_y - origin_.y);
    const float z = static_cast<float>(wide_z - origin_.z);
    if (!in_range(x) || !in_range(y) || !in_range(z)) note_unusable(x, y, z, place());
    work(1);
    std::vector<float>& vertices = scene_.vertices;
    if (vertices.capacity() - vertices.size() < 3) grow_vertices();
    vertices.insert(vertices.end(), {x, y, z});
  }

  // The vertices so far, over all meshes. Indices that a mesh counts from its own first vertex are
  // made absolute by the reader.
  uint64_t vertex_count() const { return scene_.vertices.size() / 3; }

  // Adds a polygon: corners are indices into all vertices so far. It becomes as many triangles as
  // it has corners, less two: the fan about its first corner where that covers it, others where not
  // (polygon.h). One of fewer than three corners is passed over with a note. `place` as above.
  // Errors: INDEX, and NOT_FINITE or TOO_LARGE for a vertex that no triangle may use (corner,
  // vertex and place named); TOO_LARGE for too many triangles; MEMORY_LIMIT.
  void add_polygon(std::span<const uint64_t> corners, const char* place) {
    add_polygon(corners, [place] { return std::string(place); });
  }
  template <std::invocable Place>
  void add_polygon(std::span<const uint64_t> corners, const Place& place) {
    if (corners.size() < 3) {
      note(SOBB_NOTE_SHORT_FACE, [&] { return short_face(corners.size(), place()); });
      return;
    }
    const uint64_t vertices = vertex_count();
    bool good = unusable_ == 0 || are_usable(corners);
    for (const uint64_t corner : corners) good &= corner < vertices;
    if (!good) refuse_polygon(corners, place());
    work(corners.size());
    if (corners.size() == 3) {
      add_triangle(corners[0], corners[1], corners[2]);
    } else {
      add_larger_polygon(corners);
    }
  }

  // Appends to a reader's array of corners, which a hostile file may make as long as itself.
  void push_corner(std::vector<uint64_t>& corners, uint64_t corner) {
    if (corners.size() == corners.capacity()) grow_corners(corners);
    corners.push_back(corner);
  }

  // Makes room for that many more vertices and triangles, and refuses too many before they come
  // (TOO_LARGE, MEMORY_LIMIT). A reader first refuses counts that its file cannot hold.
  void expect(uint64_t vertices, uint64_t triangles);

  // The first part of expect(), without making room. Error TOO_LARGE.
  void check_counts(uint64_t vertices, uint64_t triangles) const;

  // Passes `count` items of the source over, see add_note().
  template <std::invocable Message>
  void note(sobb_note_cause cause, const Message& message, uint64_t count = 1) {
    add_note(scene_, cause, message, count);
  }

  // Keeps a camera of the source, from which views can be made once the scene is measured.
  void add_camera(SceneCamera camera) {
    camera.eye = camera.eye - origin_;
    cameras_.push_back(camera);
  }
  const std::vector<SceneCamera>& cameras() const { return cameras_; }

  // Ends the scene: closes the last mesh, counts degenerate triangles, measures the bounds, and
  // moves vertices that no triangle may use to the origin. Error EMPTY where no triangle came.
  void finish();

 private:
  static bool in_range(float x) {  // not for NaN
    return x >= -kLargestCoordinate && x <= kLargestCoordinate;
  }

  void add_triangle(uint64_t a, uint64_t b, uint64_t c) {
    std::vector<uint32_t>& indices = scene_.indices;
    if (indices.capacity() - indices.size() < 3) grow_indices();
    indices.insert(indices.end(), {uint32_t(a), uint32_t(b), uint32_t(c)});
  }

  void add_larger_polygon(std::span<const uint64_t> corners);
  void add_ears(std::span<const uint64_t> corners);
  void note_unusable(float x, float y, float z, const std::string& place);
  bool is_usable(uint64_t vertex) const;
  bool are_usable(std::span<const uint64_t> corners) const;
  void clear_unusable();
  static std::string short_face(size_t corners, const std::string& place);
  [[noreturn]] void refuse_polygon(std::span<const uint64_t> corners,
                                   const std::string& place) const;
  [[noreturn]] void refuse_empty() const;
  [[noreturn]] void refuse_memory(uint64_t bytes) const;
  void grow_vertices();
  void grow_indices();
  void grow_corners(std::vector<uint64_t>& corners);
  void report();
  void end_mesh();
  template <class T>
  void reserve(std::vector<T>& array, uint64_t size);

  std::string name_;
  uint64_t memory_limit_;
  uint64_t held_ = 0;
  Scene& scene_;
  Vec3 origin_;
  uint64_t unusable_ = 0;     // vertices that no polygon may use
  std::vector<Vec3> points_;  // of the polygon that is split
  std::vector<SceneCamera> cameras_;
  Progress* progress_;
  double reached_ = 0;
  uint64_t until_report_;  // vertices' worth of work
};

}  // namespace sobb
