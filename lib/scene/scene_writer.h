// SPDX-License-Identifier: Apache-2.0
// How an importer hands over its triangles: checked as they come, so that no importer repeats it.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "scene/scene.h"

namespace sobb {

// Fills a scene. `name` is the source, for messages; `memory_limit` (0 for none) bounds the bytes
// that the scene's arrays may take, checked before they grow.
class SceneWriter {
 public:
  SceneWriter(std::string name, uint64_t memory_limit, Scene& scene);

  // Starts a mesh; vertices and triangles that follow are its own.
  void begin_mesh(std::string name);

  // Adds a vertex. `place` says where in the source, as in "line 12" or "mesh 3, vertex 7".
  // Errors: NOT_FINITE, TOO_LARGE (beyond 2^60), MEMORY_LIMIT.
  void add_vertex(float x, float y, float z, const char* place);

  // Vertices so far, over all meshes: what indices of a mesh are relative to is the importer's.
  uint64_t vertex_count() const { return scene_.vertices.size() / 3; }

  // Adds a polygon of at least three corners as a fan about its first: corners are indices into
  // all vertices so far. Errors: INDEX (corner and place named), SCENE_SYNTAX for fewer than three
  // corners, TOO_LARGE, MEMORY_LIMIT.
  void add_polygon(std::span<const uint64_t> corners, const char* place);

  // The bytes that `count` more vertices and triangles will take are known: refuse them early.
  // A file that declares more than it can hold must be refused by its reader before this.
  void expect(uint64_t vertices, uint64_t triangles);

  // Ends the scene. Error EMPTY where no triangle came.
  void finish();

 private:
  void charge(uint64_t bytes);

  std::string name_;
  uint64_t memory_limit_;
  uint64_t charged_ = 0;
  Scene& scene_;
};

}  // namespace sobb
