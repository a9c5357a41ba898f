// SPDX-License-Identifier: Apache-2.0
// glTF and GLB that are wrong get a status and a message with the place, and never crash.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scene/gltf_testing.h"
#include "scene/load.h"

namespace sobb {
namespace {

using namespace gltf_testing;
using reader_testing::read_hostile;

constexpr sobb_status kSyntax = SOBB_ERROR_SCENE_SYNTAX;

// Expects that the square is refused with one member of its document replaced.
void expect_refused(const char* pointer, const json& value, sobb_status status,
                    const std::string& part) {
  GltfFile file = square();
  file.document[json::json_pointer(pointer)] = value;
  SCOPED_TRACE(pointer);
  expect_error(file, status, part);
}

TEST(GltfErrors, RefusesAccessorsThatLeaveTheirViews) {
  const uint64_t big = uint64_t(1) << 53;
  expect_refused("/accessors/0/count", 5, kSyntax, "accessors[0] leaves bufferViews[0]");
  expect_refused("/accessors/0/count", big, kSyntax, "accessors[0] leaves");
  expect_refused("/accessors/0/byteOffset", 1, kSyntax, "accessors[0] leaves");
  expect_refused("/accessors/0/byteOffset", big, kSyntax, "accessors[0] leaves");
  expect_refused("/accessors/0/bufferView", 9, kSyntax, "accessors[0]");
  expect_refused("/accessors/0/type", "VEC2", kSyntax, "accessors[0] is not of three floats");
  expect_refused("/accessors/1/componentType", kFloat, kSyntax, "accessors[1] is not of unsigned");
  expect_refused("/bufferViews/0/byteLength", 13, kSyntax, "accessors[0] leaves");
  expect_refused("/bufferViews/0/byteOffset", big, kSyntax, "leaves its buffer");
  expect_refused("/bufferViews/0/byteStride", 8, kSyntax, "larger than the stride");
  expect_refused("/bufferViews/0/byteStride", 252, kSyntax, "accessors[0] leaves");
  expect_refused("/bufferViews/0/buffer", 1, kSyntax, "names no buffer");
  GltfFile unbacked = square();
  unbacked.document["accessors"][0].erase("bufferView");
  unbacked.document["accessors"][0]["count"] = 4'000'000'000;
  expect_error(unbacked, kSyntax, "has no bufferView");
}

TEST(GltfErrors, RefusesWrongTypesByPlace) {
  expect_refused("/accessors/0/count", "x", kSyntax, "accessors[0].count is not an integer");
  expect_refused("/accessors/0/count", -1, kSyntax, "accessors[0].count");
  expect_refused("/accessors/0/count", 1.5, kSyntax, "accessors[0].count is not an integer");
  expect_refused("/meshes/0/primitives/0/indices", "x", kSyntax, "primitives[0].indices");
  expect_refused("/meshes/0/primitives/0/attributes", 3, kSyntax, "primitives[0].attributes");
  expect_refused("/meshes/0/primitives/0/attributes/POSITION", 7, kSyntax, "accessors[7]");
  expect_refused("/meshes/0/primitives/0/mode", 7, kSyntax, "mode is 7");
  expect_refused("/meshes/0/primitives", 3, kSyntax, "meshes[0].primitives is not an array");
  expect_refused("/nodes", 3, kSyntax, "nodes is not an array");
  expect_refused("/nodes/0", 3, kSyntax, "nodes[0] is not an object");
  expect_refused("/nodes/0/matrix", {1, 2, 3}, kSyntax, "nodes[0].matrix has a wrong length");
  expect_refused("/nodes/0/rotation", {1, 2, 3, "x"}, kSyntax, "nodes[0].rotation is not a number");
  expect_refused("/nodes/0/mesh", 5, kSyntax, "nodes[0] names no mesh, 5");
  expect_refused("/scenes/0/nodes", {4}, kSyntax, "node 4 does not exist");
  expect_refused("/scene", 4, kSyntax, "default scene");
}

TEST(GltfErrors, RefusesCycles) {
  expect_refused("/nodes/0/children", {0}, kSyntax, "nodes form a cycle at nodes[0]");
  GltfFile file = square();
  file.document["nodes"][0]["children"] = {1};
  file.add("nodes", {{"children", {2}}});
  file.add("nodes", {{"children", {1}}});
  expect_error(file, kSyntax, "nodes form a cycle at nodes[1]");
  file.document["nodes"][2]["children"] = {0};
  file.document.erase("scenes");
  file.document.erase("scene");
  expect_error(file, kSyntax, "nodes form a cycle");
}

TEST(GltfErrors, PlacesANodeBelowEachOfItsParents) {
  GltfFile file = square();
  file.add_root({{"children", {0}}, {"translation", {5, 0, 0}}});
  file.add_root({{"children", {0, 0}}, {"scale", {2, 2, 2}}});
  const Scene scene = read(file);
  EXPECT_EQ(scene.meshes.size(), 4U);
  EXPECT_EQ(area(scene), 1 + 1 + 4 + 4);
  EXPECT_EQ(scene.bounds_max, (std::array<float, 3>{6, 2, 0}));
}

// Each node is twice below the one before it: 61 nodes would be placed 2^60 times.
TEST(GltfErrors, RefusesNodesThatAreTooMany) {
  GltfFile file = square();
  for (int i = 0; i < 60; ++i) file.add("nodes", {{"children", {i, i}}});
  file.document["scenes"][0]["nodes"] = {60};
  expect_error(file, SOBB_ERROR_TOO_LARGE, "nodes have several parents");
  Scene scene;
  SceneWriter writer("scene", 4'000'000, scene);
  test::expect_failure(SOBB_ERROR_MEMORY_LIMIT, "", [&] { read_gltf(file.glb(), writer); });
}

TEST(GltfErrors, ReadsNodesNestedAsDeepAsAFileLikes) {
  GltfFile file = square();
  constexpr int kDepth = 20'000;
  for (int i = 1; i < kDepth; ++i) file.add("nodes", {{"children", {i - 1}}});
  file.document["scenes"][0]["nodes"] = {kDepth - 1};
  EXPECT_EQ(read(file).indices.size(), 6U);
}

TEST(GltfErrors, RefusesBadTriangles) {
  GltfFile file = square();
  const size_t out = file.add_indices<uint16_t>({0, 1, 4}, kUshort);
  file.document["meshes"][0]["primitives"][0]["indices"] = out;
  expect_error(file, SOBB_ERROR_INDEX, "meshes[0].primitives[0]: index 2 names vertex 4 of 4");
  GltfFile nan = square();
  const float bad = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(&nan.binary[16], &bad, sizeof bad);
  expect_error(nan, SOBB_ERROR_NOT_FINITE, "meshes[0].primitives[0]: corner 1: vertex (");
  expect_refused("/nodes/0/scale", {1e30, 1, 1}, SOBB_ERROR_TOO_LARGE, "corner 1: vertex (1e+30");
  expect_refused("/nodes/0/scale", {1e300, 1e300, 1}, SOBB_ERROR_NOT_FINITE,
                 "corner 1: vertex (inf");
  expect_refused("/meshes/0/primitives/0/mode", 1, SOBB_ERROR_EMPTY, "no triangles");
}

TEST(GltfErrors, RefusesBadSparseAccessors) {
  GltfFile file = square();
  const size_t places = file.add_view(raw(std::vector<uint8_t>{9}));
  const size_t values = file.add_view(raw(std::vector<float>{5, 6, 7}));
  json& sparse = file.document["accessors"][0]["sparse"];
  sparse = {{"count", 1},
            {"indices", {{"bufferView", places}, {"componentType", kUbyte}}},
            {"values", {{"bufferView", values}}}};
  expect_error(file, kSyntax, "accessors[0] replaces element 9 of 4");
  sparse["count"] = 100;
  expect_error(file, kSyntax, "accessors[0] leaves bufferViews");
  sparse["indices"].erase("bufferView");
  expect_error(file, kSyntax, "bufferView");
}

TEST(GltfErrors, RefusesOtherJson) {
  const auto refused = [](const std::string& bytes, const std::string& part) {
    reader_testing::expect_error(read_gltf, bytes, kSyntax, part);
  };
  refused("", "parse error");
  refused("[]", "the document is not an object");
  refused("{\n  \"asset\": }", "line 2, column 12");
  refused("{}", "asset.version is missing");
  refused(R"({"asset": {}})", "asset.version is missing");
  refused(R"({"asset": 3})", "asset.version is missing");
  refused(std::string(100'000, '['), "nested deeper");
  refused(R"({"asset": {"version": "2.0"}, "x": 1e999})", "overflow");
}

TEST(GltfErrors, CountsInstancesBeforeTheyTakeMemory) {
  GltfFile file;
  const size_t zeros =
      file.add("accessors", {{"componentType", 5126}, {"count", 30'000}, {"type", "VEC3"}});
  file.add_mesh(zeros);
  for (int i = 0; i < 100; ++i) file.add_root({{"mesh", 0}});
  const std::string bytes = file.glb();
  Scene scene;
  SceneWriter writer("scene", 4'000'000, scene);  // of some 48 million
  test::expect_failure(SOBB_ERROR_MEMORY_LIMIT, "", [&] { read_gltf(bytes, writer); });
  EXPECT_EQ(scene.vertices.capacity(), 0U);
}

// A file with most features, small enough for every byte.
GltfFile rich() {
  GltfFile file = square();
  const size_t places = file.add_view(raw(std::vector<uint8_t>{1}));
  const size_t values = file.add_view(raw(std::vector<float>{5, 6, 7}));
  file.document["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", places}, {"componentType", kUbyte}}},
      {"values", {{"bufferView", values}}}};
  file.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}});
  file.add_root({{"camera", 0}, {"rotation", {0, 0, 1, 0}}, {"mesh", file.add_mesh(0, -1, 5)}});
  return file;
}

TEST(GltfErrors, SurvivesTruncationAtEveryByte) {
  const std::string glb = rich().glb();
  ASSERT_TRUE(read_hostile(read_gltf, glb));
  for (size_t size = 0; size < glb.size(); ++size) {
    EXPECT_FALSE(read_hostile(read_gltf, glb.substr(0, size))) << size;
  }
  const std::string gltf = rich().gltf("data:;base64," + std::string(120, 'A'));
  ASSERT_TRUE(read_hostile(read_gltf, gltf));
  for (size_t size = 0; size < gltf.size(); ++size) {
    EXPECT_FALSE(read_hostile(read_gltf, gltf.substr(0, size))) << size;
  }
}

TEST(GltfErrors, SurvivesAnyByteChanged) {
  const std::string glb = rich().glb();
  const std::string gltf = rich().gltf("data:;base64," + std::string(120, 'A'));
  for (const std::string& good : {glb, gltf}) {
    for (size_t i = 0; i < good.size(); ++i) {
      for (const int change : {0x01, 0x02, 0x10, 0x7F, 0x80, 0xFF}) {
        std::string bad = good;
        bad[i] = char(bad[i] ^ change);
        read_hostile(read_gltf, bad);
      }
      for (const char digit : {'9', '-', 'e', '"', ']', '}'}) {
        std::string bad = good;
        bad[i] = digit;
        read_hostile(read_gltf, bad);
      }
    }
  }
}

}  // namespace
}  // namespace sobb
