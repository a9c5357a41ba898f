// SPDX-License-Identifier: Apache-2.0
// GltfFile makes glTF files in the tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/gltf/gltf.h"
#include "scene/reader_testing.h"

namespace sobb::gltf_testing {

using nlohmann::json;

template <class T>
std::string raw(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

enum Component { kByte = 5120, kUbyte, kShort, kUshort, kUint = 5125, kFloat = 5126 };

// A document with one buffer. Every add function returns the new element's index.
class GltfFile {
 public:
  GltfFile() { document["asset"]["version"] = "2.0"; }

  size_t add(const char* array, json element) {
    document[array].push_back(std::move(element));
    return document[array].size() - 1;
  }
  size_t add_view(const std::string& bytes, uint64_t stride = 0) {
    while (binary.size() % 4 != 0) binary += '\0';
    json view = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
    if (stride != 0) view["byteStride"] = stride;
    binary += bytes;
    return add("bufferViews", view);
  }
  size_t add_positions(const std::vector<float>& xyz) {
    return add("accessors", {{"bufferView", add_view(raw(xyz))},
                             {"componentType", kFloat},
                             {"count", xyz.size() / 3},
                             {"type", "VEC3"}});
  }
  template <class T>
  size_t add_indices(const std::vector<T>& indices, Component type) {
    return add("accessors", {{"bufferView", add_view(raw(indices))},
                             {"componentType", type},
                             {"count", indices.size()},
                             {"type", "SCALAR"}});
  }
  // A mesh of one primitive; no indices where `indices` is negative.
  size_t add_mesh(size_t positions, int indices = -1, int mode = 4) {
    json primitive = {{"attributes", {{"POSITION", positions}}}, {"mode", mode}};
    if (indices >= 0) primitive["indices"] = indices;
    return add("meshes", {{"primitives", {primitive}}});
  }
  // A root node of the default scene.
  size_t add_root(json node) {
    const size_t index = add("nodes", std::move(node));
    document["scene"] = 0;
    document["scenes"][0]["nodes"].push_back(index);
    return index;
  }

  std::string glb() const {
    json complete = document;
    complete["buffers"][0]["byteLength"] = binary.size();
    std::string text = complete.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string padded = binary;
    padded.resize((padded.size() + 3) / 4 * 4, '\0');
    return "glTF" + word(2) + word(uint32_t(28 + text.size() + padded.size())) +
           word(uint32_t(text.size())) + "JSON" + text + word(uint32_t(padded.size())) +
           std::string("BIN\0", 4) + padded;
  }
  // The JSON alone, whose buffer is at the URI.
  std::string gltf(const std::string& uri) const {
    json complete = document;
    complete["buffers"][0] = {{"byteLength", binary.size()}, {"uri", uri}};
    return complete.dump();
  }

  static std::string word(uint32_t value) { return raw(std::vector{value}); }

  json document;
  std::string binary;
};

// A unit square on one root node: 4 vertices, and 6 indices of two triangles.
inline const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
inline GltfFile square() {
  GltfFile file;
  const size_t positions = file.add_positions(kSquare);
  const size_t indices = file.add_indices<uint16_t>({0, 1, 2, 0, 2, 3}, kUshort);
  file.add_root({{"mesh", file.add_mesh(positions, int(indices))}});
  return file;
}

inline Scene read(const GltfFile& file) {
  return reader_testing::read_scene(read_gltf, file.glb());
}
// The area of a scene's triangles.
inline double area(const Scene& scene) {
  double sum = 0;
  for (size_t t = 0; t < scene.indices.size(); t += 3) {
    const auto corner = [&](size_t k) { return &scene.vertices[3 * size_t(scene.indices[t + k])]; };
    double u[3];
    double v[3];
    for (size_t k = 0; k < 3; ++k) {
      u[k] = double(corner(1)[k]) - double(corner(0)[k]);
      v[k] = double(corner(2)[k]) - double(corner(0)[k]);
    }
    sum += std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                      u[0] * v[1] - u[1] * v[0]) /
           2;
  }
  return sum;
}

// What a scene notes for a cause: how often, and the first time.
inline SceneNote note_of(const Scene& scene, sobb_note_cause cause) {
  const auto found = std::ranges::find(scene.notes, cause, &SceneNote::cause);
  return found != scene.notes.end() ? *found : SceneNote{cause, 0, ""};
}

inline void expect_note(const Scene& scene, sobb_note_cause cause, uint64_t count,
                        const std::string& part) {
  const SceneNote note = note_of(scene, cause);
  EXPECT_EQ(note.count, count) << note.first;
  EXPECT_NE(note.first.find(part), std::string::npos) << note.first;
}

// Expects the triangles of square(), and as many notes as there are causes to.
inline void expect_square(const Scene& scene, size_t notes = 0) {
  EXPECT_EQ(scene.indices.size(), 6U);
  EXPECT_EQ(area(scene), 1);
  EXPECT_EQ(scene.bounds_min, (std::array<float, 3>{0, 0, 0}));
  EXPECT_EQ(scene.bounds_max, (std::array<float, 3>{1, 1, 0}));
  EXPECT_EQ(scene.notes.size(), notes);
}

inline void expect_error(const GltfFile& file, sobb_status status, const std::string& part) {
  reader_testing::expect_error(read_gltf, file.glb(), status, part);
}

}  // namespace sobb::gltf_testing
