// SPDX-License-Identifier: Apache-2.0
// The glTF reader: every way in which triangles, transforms and cameras come.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "scene/gltf_testing.h"
#include "scene/load.h"

namespace sobb {
namespace {

using namespace gltf_testing;
using reader_testing::Indices;
using reader_testing::read_scene;
using Floats = std::vector<float>;

// The positions of the triangles' corners, which do not depend on the vertices' order.
Floats corners(const Scene& scene) {
  Floats result;
  for (const uint32_t i : scene.indices) {
    result.insert(result.end(), &scene.vertices[3 * size_t(i)], &scene.vertices[3 * size_t(i)] + 3);
  }
  return result;
}

TEST(Gltf, ReadsIndexedTriangles) {
  const Scene scene = read(square());
  EXPECT_EQ(scene.vertices, kSquare);
  EXPECT_EQ(scene.indices, (Indices{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(scene.meshes.size(), 1U);
  EXPECT_EQ(scene.bounds_max, (std::array<float, 3>{1, 1, 0}));
}

TEST(Gltf, ReadsEveryIndexType) {
  for (const Component type : {kUbyte, kUshort, kUint}) {
    GltfFile file;
    const size_t positions = file.add_positions(kSquare);
    const size_t indices = type == kUbyte    ? file.add_indices<uint8_t>({3, 2, 1}, type)
                           : type == kUshort ? file.add_indices<uint16_t>({3, 2, 1}, type)
                                             : file.add_indices<uint32_t>({3, 2, 1}, type);
    file.add_root({{"mesh", file.add_mesh(positions, int(indices))}});
    EXPECT_EQ(corners(read(file)), (Floats{0, 1, 0, 1, 1, 0, 1, 0, 0})) << type;
  }
}

TEST(Gltf, ReadsTrianglesWithoutIndices) {
  GltfFile file;
  file.add_root({{"mesh", file.add_mesh(file.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0}))}});
  EXPECT_EQ(read(file).indices, (Indices{0, 1, 2}));
}

TEST(Gltf, ReadsStripsAndFans) {
  const Floats points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};
  for (const int mode : {5, 6}) {
    GltfFile file;
    file.add_root({{"mesh", file.add_mesh(file.add_positions(points), -1, mode)}});
    const Indices strip = {0, 1, 2, 1, 3, 2, 2, 3, 4};
    const Indices fan = {1, 2, 0, 2, 3, 0, 3, 4, 0};
    EXPECT_EQ(read(file).indices, mode == 5 ? strip : fan);
  }
}

TEST(Gltf, IgnoresPointsLinesAndWhatHasNoPositions) {
  GltfFile file = square();
  json& primitives = file.document["meshes"][0]["primitives"];
  for (const int mode : {0, 1, 2, 3}) {
    primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", mode}});
  }
  primitives.push_back({{"attributes", {{"NORMAL", 0}}}});
  EXPECT_EQ(read(file).indices.size(), 6U);
}

TEST(Gltf, ReadsStridedAndOffsetAccessors) {
  GltfFile file;
  const Floats rows = {9, 9, 0, 0, 0, 9, 9, 9, 1, 0, 0, 9, 9, 9, 0, 1, 0, 9};
  const size_t positions = file.add("accessors", {{"bufferView", file.add_view(raw(rows), 24)},
                                                  {"byteOffset", 8},
                                                  {"componentType", kFloat},
                                                  {"count", 3},
                                                  {"type", "VEC3"}});
  file.add_root({{"mesh", file.add_mesh(positions)}});
  EXPECT_EQ(read(file).vertices, (Floats{0, 0, 0, 1, 0, 0, 0, 1, 0}));
}

TEST(Gltf, AppliesSparseAccessors) {
  for (const bool backed : {true, false}) {
    GltfFile file;
    const size_t positions = file.add_positions(kSquare);
    json& accessor = file.document["accessors"][positions];
    if (!backed) accessor.erase("bufferView");
    const size_t places = file.add_view(raw(std::vector<uint8_t>{1, 3}));
    const size_t values = file.add_view(raw(Floats{5, 6, 7, 8, 9, 10}));
    accessor["sparse"] = {{"count", 2},
                          {"indices", {{"bufferView", places}, {"componentType", kUbyte}}},
                          {"values", {{"bufferView", values}}}};
    file.add_root({{"mesh", file.add_mesh(positions, -1, 6)}});
    const Floats expected = backed ? Floats{0, 0, 0, 5, 6, 7, 1, 1, 0, 8, 9, 10}
                                   : Floats{0, 0, 0, 5, 6, 7, 0, 0, 0, 8, 9, 10};
    EXPECT_EQ(read(file).vertices, expected);
  }
}

TEST(Gltf, AppliesSparseIndices) {
  for (const bool backed : {true, false}) {
    GltfFile file = square();
    const size_t places = file.add_view(raw(std::vector<uint16_t>{0, 1, 2, 3, 4, 5}));
    const size_t values = file.add_view(raw(std::vector<uint16_t>{0, 1, 2, 0, 2, 3}));
    json& accessor = file.document["accessors"][1];
    if (!backed) accessor.erase("bufferView");
    accessor["sparse"] = {{"count", 6},
                          {"indices", {{"bufferView", places}, {"componentType", kUshort}}},
                          {"values", {{"bufferView", values}}}};
    expect_square(read(file));
    // Indices that are not replaced stay, or are zero.
    accessor["sparse"]["count"] = 3;
    EXPECT_EQ(read(file).indices,
              backed ? (Indices{0, 1, 2, 0, 2, 3}) : (Indices{0, 1, 2, 0, 0, 0}));
    // All zeros are degenerate triangles.
    accessor.erase("sparse");
    EXPECT_EQ(read(file).degenerate_count, backed ? 0U : 2U);
  }
}

TEST(Gltf, ReadsQuantizedPositions) {
  const auto file_of = [](const std::string& bytes, Component type, bool normalized) {
    GltfFile file;
    file.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    const size_t stride = type == kByte || type == kUbyte ? 4 : 8;
    const size_t positions = file.add("accessors", {{"bufferView", file.add_view(bytes, stride)},
                                                    {"componentType", type},
                                                    {"count", 3},
                                                    {"normalized", normalized},
                                                    {"type", "VEC3"}});
    file.add_root({{"mesh", file.add_mesh(positions)}});
    return file;
  };
  const std::string bytes = raw(std::vector<int8_t>{0, 127, -128, 0, 1, 2, 3, 0, 4, 5, -6, 0});
  const Floats integers = {0, 127, -128, 1, 2, 3, 4, 5, -6};
  EXPECT_EQ(read(file_of(bytes, kByte, false)).vertices, integers);
  const Floats normalized = read(file_of(bytes, kByte, true)).vertices;
  EXPECT_EQ(normalized[1], 1);
  EXPECT_EQ(normalized[2], -1);
  EXPECT_EQ(normalized[8], float(-6 / 127.0));
  const Floats ubytes = {0, 127, 128, 1, 2, 3, 4, 5, 250};
  EXPECT_EQ(read(file_of(bytes, kUbyte, false)).vertices, ubytes);
  EXPECT_EQ(read(file_of(bytes, kUbyte, true)).vertices[2], float(128 / 255.0));
  const std::string words = raw(std::vector<uint16_t>{0, 65535, 1, 0, 2, 3, 32768, 0, 5, 6, 7, 0});
  EXPECT_EQ(read(file_of(words, kUshort, false)).vertices,
            (Floats{0, 65535, 1, 2, 3, 32768, 5, 6, 7}));
  EXPECT_EQ(read(file_of(words, kUshort, true)).vertices[1], 1);
  EXPECT_EQ(read(file_of(words, kShort, false)).vertices,
            (Floats{0, -1, 1, 2, 3, -32768, 5, 6, 7}));
  const Floats shorts = read(file_of(words, kShort, true)).vertices;
  EXPECT_EQ(shorts[1], float(-1 / 32767.0));
  EXPECT_EQ(shorts[5], -1);

  GltfFile unannounced = file_of(bytes, kByte, false);
  unannounced.document.erase("extensionsRequired");
  expect_error(unannounced, SOBB_ERROR_SCENE_SYNTAX, "accessors[0] is not of three floats");
}

TEST(Gltf, PlacesEveryInstanceByNestedTransforms) {
  GltfFile file = square();
  file.document["scenes"][0]["nodes"] = json::array();
  file.document["nodes"][0]["scale"] = {2, 3, 4};
  // A quarter turn about z, column by column, and a translation.
  const json turn = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1};
  file.add_root({{"matrix", turn}, {"children", {0, 2}}});
  file.add("nodes", {{"mesh", 0}, {"translation", {1, 0, 0}}, {"rotation", {0, 0, 1, 0}}});
  const Scene scene = read(file);
  ASSERT_EQ(scene.meshes.size(), 2U);
  EXPECT_EQ(scene.meshes[1].first_triangle, 2U);
  EXPECT_EQ(Floats(scene.vertices.begin(), scene.vertices.begin() + 12),
            (Floats{10, 20, 30, 10, 22, 30, 7, 22, 30, 7, 20, 30}));
  // A half turn about z, one along x, then the parent's quarter turn.
  EXPECT_EQ(Floats(scene.vertices.begin() + 12, scene.vertices.end()),
            (Floats{10, 21, 30, 10, 20, 30, 11, 20, 30, 11, 21, 30}));
}

TEST(Gltf, KeepsTheBitsOfAnIdentityTransform) {
  GltfFile file;
  const Floats points = {-0.0F, 1e-45F, 0.1F, 1, 2, 3, -5, 0x1p60F, 7};
  file.add_root({{"mesh", file.add_mesh(file.add_positions(points))},
                 {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
  file.document["nodes"].push_back({{"children", {0}}, {"scale", {1, 1, 1}}});
  file.document["scenes"][0]["nodes"] = {1};
  const Scene scene = read(file);
  EXPECT_EQ(raw(scene.vertices), raw(points));
}

TEST(Gltf, ShowsTheDefaultSceneElseTheFirstElseAllRoots) {
  GltfFile file = square();
  file.add("nodes", {{"mesh", 0}, {"translation", {5, 0, 0}}});
  file.add("scenes", {{"nodes", {0, 1}}});
  EXPECT_EQ(read(file).meshes.size(), 1U);
  file.document["scene"] = 1;
  EXPECT_EQ(read(file).meshes.size(), 2U);
  file.document.erase("scene");
  EXPECT_EQ(read(file).meshes.size(), 1U);
  file.document.erase("scenes");
  EXPECT_EQ(read(file).meshes.size(), 2U);
  file.document.erase("nodes");
  EXPECT_EQ(read(file).meshes.size(), 1U);  // a library of meshes
}

TEST(Gltf, NamesMeshesByMeshElseByNode) {
  GltfFile file = square();
  file.document["nodes"][0]["name"] = "node";
  EXPECT_EQ(read(file).meshes[0].name, "node");
  file.document["meshes"][0]["name"] = "mesh \xC3\xA9";
  EXPECT_EQ(read(file).meshes[0].name, "mesh \xC3\xA9");
}

TEST(Gltf, TakesOnlyTheVerticesThatASmallPrimitiveUses) {
  GltfFile file;
  Floats many;
  for (int i = 0; i < 1000; ++i) many.insert(many.end(), {float(i), float(i * i % 7), 0});
  const size_t positions = file.add_positions(many);
  json primitives = json::array();
  for (uint16_t first : {uint16_t(0), uint16_t(500), uint16_t(990)}) {
    const uint16_t next = first + 1;
    const uint16_t last = first + 5;
    const size_t indices =
        file.add_indices<uint16_t>({last, first, next, first, last, next}, kUshort);
    primitives.push_back({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
  }
  file.add_root({{"mesh", file.add("meshes", {{"primitives", primitives}})}});
  const Scene scene = read(file);
  EXPECT_EQ(scene.vertices.size(), 27U);
  EXPECT_EQ(corners(scene)[0], 5);
  EXPECT_EQ(corners(scene)[18], 505);
}

TEST(Gltf, CountsDegenerateTriangles) {
  GltfFile file;
  const size_t positions = file.add_positions({0, 0, 0, 1, 1, 1, 2, 2, 2, 0, 1, 0});
  const size_t indices = file.add_indices<uint8_t>({0, 1, 2, 0, 1, 1, 0, 1, 3, 3, 3, 3}, kUbyte);
  file.add_root({{"mesh", file.add_mesh(positions, int(indices))}});
  EXPECT_EQ(read(file).degenerate_count, 3U);
}

TEST(Gltf, NeverReadsImages) {
  GltfFile file = square();
  file.add("images", {{"uri", "missing.png"}});
  file.add("images", {{"bufferView", 12345}, {"mimeType", "image/png"}});
  file.add("textures", {{"source", 7}});
  file.add("materials", {{"pbrMetallicRoughness", 3}});
  file.document["extensionsRequired"] = {"KHR_materials_unlit", "KHR_texture_transform"};
  EXPECT_EQ(read(file).indices.size(), 6U);
}

TEST(Gltf, KeepsPerspectiveCamerasAsPlaced) {
  GltfFile file = square();
  file.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}});
  file.add("cameras", {{"type", "orthographic"},
                       {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 2}, {"znear", 1}}}});
  file.add_root({{"camera", 1}});
  file.add_root({{"camera", 0}, {"translation", {1, 2, 3}}});
  const std::string bytes = file.glb();
  Scene scene;
  SceneWriter writer("scene", 0, scene);
  read_gltf(bytes, writer);
  ASSERT_EQ(writer.cameras().size(), 1U);
  const SceneCamera& camera = writer.cameras()[0];
  EXPECT_EQ(camera.vfov_radians, 1.0);
  EXPECT_EQ(camera.eye.x, 1);
  EXPECT_EQ(camera.eye.y, 2);
  EXPECT_EQ(camera.eye.z, 3);
  EXPECT_EQ(camera.forward.z, -1);
  EXPECT_EQ(camera.up.y, 1);
}

// The README of the scenes gives these counts of triangles.
TEST(Gltf, ReadsRealScenes) {
  const char* folder = std::getenv("SOBB_SCENES");
  if (folder == nullptr) GTEST_SKIP() << "SOBB_SCENES names no folder of scenes";
  const std::pair<const char*, uint64_t> scenes[] = {{"sanmiguel", 9'384'742},
                                                     {"crown", 3'541'162},
                                                     {"chopper-titan-partial", 2'542'918},
                                                     {"stk-black_forest", 1'105'601},
                                                     {"sintel-hair", 1'033'552},
                                                     {"bathroom", 591'922},
                                                     {"stk-candela_city", 444'542},
                                                     {"robot-baxter", 412'363},
                                                     {"motorbike", 331'653},
                                                     {"nefertiti", 99'938},
                                                     {"sponza-dabrovic", 67'405},
                                                     {"tree-fbx", 38'253},
                                                     {"2CylinderEngine", 121'496}};
  size_t read = 0;
  for (const auto& [name, triangles] : scenes) {
    const std::string path = std::string(folder) + "/" + name + ".glb";
    if (!std::ifstream(path)) continue;
    EXPECT_EQ(load_scene(path, nullptr, 0).indices.size() / 3, triangles) << name;
    ++read;
  }
  if (read == 0) GTEST_SKIP() << "none of the scenes in " << folder;
}

}  // namespace
}  // namespace sobb
