// SPDX-License-Identifier: Apache-2.0
// How an importer hands over its triangles: checked as they come, so that no importer repeats it.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "scene/scene.h"

namespace sobb {

// Fills a scene. `name` is the source, for messages; `memory_limit` (0 for none) bounds the bytes
// that the scene and its importer may take, checked before they do. `progress`, if any, is asked
// now and then whether to go on, whatever the importer is at; it is told how far that is.
class SceneWriter {
 public:
  SceneWriter(std::string name, uint64_t memory_limit, Scene& scene, Progress* progress = nullptr);

  // The importer itself holds `bytes` more (the file, its buffers): they count against the limit.
  void hold(uint64_t bytes);
  // Refuses what the importer wants to hold for a while where there is no room for it.
  void check_room(uint64_t bytes) const;

  const std::string& name() const { return name_; }
  bool has_limit() const { return memory_limit_ != 0; }
  uint64_t memory_left() const;  // what the importer may yet hold; the largest number for no limit

  // The importer has come so far, from 0 to 1. Error CANCELLED, as of all that adds to the scene.
  void reach(double fraction);
  // It did work that adds nothing, of about as much as so many vertices.
  void work(uint64_t vertices) {
    if (vertices >= until_told_) {
      tell();
    } else {
      until_told_ -= vertices;
    }
  }

  // Starts a mesh; triangles that follow are its own. A mesh without triangles leaves no trace.
  void begin_mesh(std::string name);

  // Adds a vertex. `place` says where in the source, as in "line 12" or "mesh 3, vertex 7": text,
  // or a function that makes it, called for an error only, where making it would cost too much.
  // Errors: NOT_FINITE, TOO_LARGE (beyond 2^60), MEMORY_LIMIT.
  void add_vertex(float x, float y, float z, const char* place) {
    add_vertex(x, y, z, [place] { return std::string(place); });
  }
  template <std::invocable Place>
  void add_vertex(float x, float y, float z, const Place& place) {
    if (!in_range(x) || !in_range(y) || !in_range(z)) refuse_vertex(x, y, z, place());
    work(1);
    std::vector<float>& vertices = scene_.vertices;
    if (vertices.capacity() - vertices.size() < 3) grow_vertices();
    vertices.insert(vertices.end(), {x, y, z});
  }

  // Vertices so far, over all meshes: what indices of a mesh are relative to is the importer's.
  uint64_t vertex_count() const { return scene_.vertices.size() / 3; }

  // Adds a polygon of at least three corners as a fan about its first: corners are indices into
  // all vertices so far. `place` as above. Errors: INDEX (corner and place named), SCENE_SYNTAX
  // for fewer than three corners, TOO_LARGE, MEMORY_LIMIT.
  void add_polygon(std::span<const uint64_t> corners, const char* place) {
    add_polygon(corners, [place] { return std::string(place); });
  }
  template <std::invocable Place>
  void add_polygon(std::span<const uint64_t> corners, const Place& place) {
    const uint64_t vertices = vertex_count();
    bool good = corners.size() >= 3;
    for (const uint64_t corner : corners) good &= corner < vertices;
    if (!good) refuse_polygon(corners, place());
    work(corners.size());
    std::vector<uint32_t>& indices = scene_.indices;
    for (size_t i = 2; i < corners.size(); ++i) {
      if (indices.capacity() - indices.size() < 3) grow_indices();
      indices.insert(indices.end(),
                     {uint32_t(corners[0]), uint32_t(corners[i - 1]), uint32_t(corners[i])});
    }
  }

  // Appends to an importer's array of corners, which a hostile file may make as long as itself.
  void push_corner(std::vector<uint64_t>& corners, uint64_t corner) {
    if (corners.size() == corners.capacity()) grow_corners(corners);
    corners.push_back(corner);
  }

  // So many vertices and triangles more will come: refuses too many (TOO_LARGE, MEMORY_LIMIT)
  // before they do. A file that declares more than it can hold must be refused by its reader first.
  void expect(uint64_t vertices, uint64_t triangles);

  // The first part of expect(), without making room. Error TOO_LARGE.
  void check_counts(uint64_t vertices, uint64_t triangles) const;

  // Ends the scene: closes the last mesh, counts degenerate triangles, measures the bounds. Errors
  // CANCELLED, EMPTY where no triangle came.
  void finish();

 private:
  static constexpr float kLargest = 0x1p60F;
  static bool in_range(float x) { return x >= -kLargest && x <= kLargest; }  // not for NaN

  [[noreturn]] void refuse_vertex(float x, float y, float z, const std::string& place) const;
  [[noreturn]] void refuse_polygon(std::span<const uint64_t> corners,
                                   const std::string& place) const;
  [[noreturn]] void refuse_memory(uint64_t bytes) const;
  void grow_vertices();
  void grow_indices();
  void grow_corners(std::vector<uint64_t>& corners);
  void tell();
  void end_mesh();
  template <class T>
  void reserve(std::vector<T>& array, uint64_t size);

  std::string name_;
  uint64_t memory_limit_;
  uint64_t held_ = 0;
  Scene& scene_;
  Progress* progress_;
  double reached_ = 0;
  uint64_t until_told_;
};

}  // namespace sobb
