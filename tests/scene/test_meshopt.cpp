// SPDX-License-Identifier: Apache-2.0
// Buffer views that EXT_meshopt_compression and KHR_meshopt_compression compress; in a build
// without libmeshoptimizer, that they are refused by name.
#include "scene/gltf/buffers/meshopt.h"

#include <gtest/gtest.h>

#include "scene/gltf_testing.h"

#ifdef SOBB_WITH_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

namespace sobb {
namespace {

using namespace gltf_testing;
using Floats = std::vector<float>;

constexpr const char* kExtension = "EXT_meshopt_compression";

// Compresses view `view` of the file: its elements are in the buffer no longer, but for a buffer
// without bytes that stands for them.
void compress(GltfFile& file, size_t view, const std::string& data, uint64_t stride, uint64_t count,
              const char* mode, const char* extension = kExtension) {
  const size_t place = file.add_view(data);
  json& compressed = file.document["bufferViews"][view];
  compressed["extensions"][extension] = {
      {"buffer", 0},
      {"byteOffset", file.document["bufferViews"][place]["byteOffset"]},
      {"byteLength", data.size()},
      {"byteStride", stride},
      {"count", count},
      {"mode", mode}};
  compressed["buffer"] = 1;
  compressed["byteOffset"] = 0;
  file.document["buffers"][1] = {{"byteLength", 1000},
                                 {"extensions", {{extension, {{"fallback", true}}}}}};
  file.document["extensionsUsed"] = {extension};
}

TEST(Meshopt, NamesTheExtensionOfDataThatAreNotItsOwn) {
  for (const char* extension : {kExtension, "KHR_meshopt_compression"}) {
    GltfFile file = square();
    compress(file, 0, std::string(20, '\0'), 12, 4, "ATTRIBUTES", extension);
    expect_error(file, SOBB_ERROR_SCENE_UNSUPPORTED, "bufferViews[0]: " + std::string(extension));
    file.document["extensionsRequired"] = {extension};
    expect_error(file, SOBB_ERROR_SCENE_UNSUPPORTED, extension);
  }
}

TEST(Meshopt, IsNotAskedForViewsThatNoTriangleNeeds) {
  GltfFile file = square();
  file.add_view("unused");
  compress(file, 2, std::string(20, '\0'), 12, 4, "ATTRIBUTES");
  expect_square(read(file));
}

#ifdef SOBB_WITH_MESHOPTIMIZER

template <class T>
std::string encoded_vertices(const std::vector<T>& values, size_t stride) {
  const size_t count = values.size() * sizeof(T) / stride;
  std::string data(meshopt_encodeVertexBufferBound(count, stride), '\0');
  auto* const to = reinterpret_cast<unsigned char*>(data.data());
  data.resize(meshopt_encodeVertexBuffer(to, data.size(), values.data(), count, stride));
  return data;
}

std::string encoded_triangles(const std::vector<uint32_t>& indices, size_t vertices) {
  std::string data(meshopt_encodeIndexBufferBound(indices.size(), vertices), '\0');
  auto* const to = reinterpret_cast<unsigned char*>(data.data());
  data.resize(meshopt_encodeIndexBuffer(to, data.size(), indices.data(), indices.size()));
  return data;
}

std::string encoded_indices(const std::vector<uint32_t>& indices, size_t vertices) {
  std::string data(meshopt_encodeIndexSequenceBound(indices.size(), vertices), '\0');
  auto* const to = reinterpret_cast<unsigned char*>(data.data());
  data.resize(meshopt_encodeIndexSequence(to, data.size(), indices.data(), indices.size()));
  return data;
}

const std::vector<uint32_t> kSquareIndices = {0, 1, 2, 0, 2, 3};

// A square whose positions and indices are compressed.
GltfFile compressed_square(const char* extension = kExtension) {
  GltfFile file = square();
  compress(file, 0, encoded_vertices(kSquare, 12), 12, 4, "ATTRIBUTES", extension);
  compress(file, 1, encoded_triangles(kSquareIndices, 4), 2, 6, "TRIANGLES", extension);
  return file;
}

TEST(Meshopt, DecodesPositionsAndTriangles) {
  for (const char* extension : {kExtension, "KHR_meshopt_compression"}) {
    GltfFile file = compressed_square(extension);
    expect_square(read(file));
    file.document["extensionsRequired"] = {extension};
    expect_square(read(file));
  }
}

TEST(Meshopt, DecodesIndexSequencesOfBothWidths) {
  for (const size_t width : {2, 4}) {
    GltfFile file = square();
    file.document["accessors"][1]["componentType"] = width == 2 ? kUshort : kUint;
    compress(file, 1, encoded_indices(kSquareIndices, 4), width, 6, "INDICES");
    expect_square(read(file));
    compress(file, 1, encoded_triangles(kSquareIndices, 4), width, 6, "TRIANGLES");
    expect_square(read(file));
  }
}

TEST(Meshopt, DecodesManyVertices) {
  GltfFile file;
  Floats points;
  for (int i = 0; i < 3000; ++i) points.insert(points.end(), {float(i % 60), float(i / 60), 0.5F});
  std::vector<uint32_t> indices;
  for (uint32_t row = 0; row < 49; ++row) {
    for (uint32_t i = 60 * row; i + 1 < 60 * row + 60; ++i) {
      indices.insert(indices.end(), {i, i + 1, i + 60, i + 60, i + 1, i + 61});
    }
  }
  const size_t positions = file.add_positions(points);
  const size_t corners = file.add_indices(indices, kUint);
  file.add_root({{"mesh", file.add_mesh(positions, int(corners))}});
  const Scene plain = read(file);
  compress(file, 0, encoded_vertices(points, 12), 12, 3000, "ATTRIBUTES");
  compress(file, 1, encoded_triangles(indices, 3000), 4, indices.size(), "TRIANGLES");
  const Scene scene = read(file);
  EXPECT_EQ(scene.vertices, plain.vertices);
  EXPECT_EQ(scene.indices.size(), plain.indices.size());  // triangles begin at other corners
  EXPECT_EQ(area(scene), 59 * 49);
}

TEST(Meshopt, DecodesQuantizedPositions) {
  GltfFile file;
  file.document["extensionsRequired"] = {"KHR_mesh_quantization", kExtension};
  const std::vector<int16_t> rows = {0, 0, 0, 9, 32767, 0, 0, 9, 0, 32767, 0, 9};
  const size_t positions = file.add("accessors", {{"bufferView", file.add_view(raw(rows), 8)},
                                                  {"componentType", kShort},
                                                  {"count", 3},
                                                  {"normalized", true},
                                                  {"type", "VEC3"}});
  file.add_root({{"mesh", file.add_mesh(positions)}});
  compress(file, 0, encoded_vertices(rows, 8), 8, 3, "ATTRIBUTES");
  const Scene scene = read(file);
  EXPECT_EQ(area(scene), 0.5);
  EXPECT_EQ(scene.bounds_max, (std::array<float, 3>{1, 1, 0}));
}

TEST(Meshopt, AppliesFilters) {
  GltfFile file = square();
  std::vector<uint32_t> exponential(12);
  meshopt_encodeFilterExp(exponential.data(), 4, 12, 15, kSquare.data());
  compress(file, 0, encoded_vertices(exponential, 12), 12, 4, "ATTRIBUTES");
  json& extension = file.document["bufferViews"][0]["extensions"][kExtension];
  extension["filter"] = "EXPONENTIAL";
  expect_square(read(file));
  for (const char* filter : {"OCTAHEDRAL", "QUATERNION", "COLOR", "SURPRISE"}) {
    extension["filter"] = filter;  // none of them has elements of twelve bytes
    expect_error(file, SOBB_ERROR_SCENE_UNSUPPORTED, "the filter " + std::string(filter));
  }
}

TEST(Meshopt, DecodesSparseElementsAndMorphTargets) {
  GltfFile file = compressed_square();
  const Floats shift = {0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2};
  const size_t target = file.add_positions(shift);
  const size_t view = file.document["accessors"][target]["bufferView"];
  compress(file, view, encoded_vertices(shift, 12), 12, 4, "ATTRIBUTES");
  file.document["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", target}}};
  file.document["meshes"][0]["weights"] = {0.5};
  const size_t places = file.add_view(raw(std::vector<uint8_t>{2}));
  const Floats corner = {1, 1, 8};
  const size_t values = file.add_view(raw(corner));
  compress(file, values, encoded_vertices(corner, 12), 12, 1, "ATTRIBUTES");
  file.document["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", places}, {"componentType", kUbyte}}},
      {"values", {{"bufferView", values}}}};
  const Scene scene = read(file);
  EXPECT_EQ(scene.bounds_min, (std::array<float, 3>{0, 0, 1}));
  EXPECT_EQ(scene.bounds_max, (std::array<float, 3>{1, 1, 9}));
}

TEST(Meshopt, RefusesWhatCannotBe) {
  const auto refused = [](const char* key, const json& value, const std::string& part,
                          size_t view = 0, sobb_status status = SOBB_ERROR_SCENE_SYNTAX) {
    GltfFile file = compressed_square();
    file.document["bufferViews"][view]["extensions"][kExtension][key] = value;
    SCOPED_TRACE(key);
    expect_error(file, status, part);
  };
  refused("byteStride", 0, "a byteStride of 0");
  refused("byteStride", 6, "a byteStride of 6");
  refused("byteStride", 260, "a byteStride of 260");
  refused("byteStride", 3, "a byteStride of 3", 1);
  refused("byteStride", 16, "malformed");
  refused("count", 300, "malformed");
  refused("count", 7, "no whole triangles", 1);
  refused("count", uint64_t(1) << 53, "cannot hold");
  refused("count", 3 * (uint64_t(1) << 50), "cannot hold", 1);
  refused("count", 3, "accessors[0] leaves bufferViews[0]", 0, SOBB_ERROR_SCENE_SYNTAX);
  refused("byteLength", 10, "malformed");
  refused("byteLength", 1 << 30, "leaves its buffer");
  refused("byteOffset", uint64_t(1) << 53, "leaves its buffer");
  refused("buffer", 7, "names no buffer, 7");
  refused("buffer", "x", "bufferViews[0].EXT_meshopt_compression.buffer");
  refused("mode", "SURPRISE", "the mode SURPRISE", 0, SOBB_ERROR_SCENE_UNSUPPORTED);
  refused("mode", "TRIANGLES", "a byteStride of 12");
}

TEST(Meshopt, HoldsItsElementsAgainstTheLimit) {
  // 300,000 equal vertices are few bytes.
  const Floats points(900'000, 1.0F);
  GltfFile file;
  const size_t positions = file.add_positions({0, 0, 0});
  file.document["accessors"][positions]["count"] = 300'000;
  const std::string data = encoded_vertices(points, 12);
  EXPECT_LT(data.size(), 100'000U);
  compress(file, 0, data, 12, 300'000, "ATTRIBUTES");
  const size_t corner = file.add_indices<uint16_t>({0, 1, 2}, kUshort);
  file.add_root({{"mesh", file.add_mesh(positions, int(corner))}});
  EXPECT_EQ(read(file).degenerate_count, 1U);
  const std::string bytes = file.glb();
  Scene scene;
  SceneWriter writer("scene", 2'000'000, scene);
  test::expect_failure(SOBB_ERROR_MEMORY_LIMIT, "", [&] { read_gltf(bytes, writer); });
}

TEST(Meshopt, SurvivesDamagedData) {
  const std::string glb = compressed_square().glb();
  const size_t data = glb.find("BIN") + 4;
  ASSERT_TRUE(reader_testing::read_hostile(read_gltf, glb));
  for (size_t i = data; i < glb.size(); ++i) {
    for (const int change : {1, 2, 4, 8, 16, 32, 64, 128, 255}) {
      std::string bad = glb;
      bad[i] = char(bad[i] ^ change);
      reader_testing::read_hostile(read_gltf, bad);
    }
  }
}

#else

TEST(Meshopt, TakesTheElementsThatABufferHasToo) {
  GltfFile file = square();
  compress(file, 0, std::string(20, '\0'), 12, 4, "ATTRIBUTES");
  file.document["bufferViews"][0]["buffer"] = 0;
  expect_square(read(file));
}

#endif

}  // namespace
}  // namespace sobb
