// SPDX-License-Identifier: Apache-2.0
// Default weights of morph targets, of meshes and of nodes.
#include "scene/gltf/morph.h"

#include <gtest/gtest.h>

#include "scene/gltf_testing.h"

namespace sobb {
namespace {

using namespace gltf_testing;
using Floats = std::vector<float>;
using Bounds = std::array<float, 3>;

// A square with targets that displace it along x, y and z by one.
GltfFile morphing() {
  GltfFile file = square();
  json& primitive = file.document["meshes"][0]["primitives"][0];
  for (size_t axis = 0; axis < 3; ++axis) {
    Floats shift(12);
    for (size_t i = axis; i < shift.size(); i += 3) shift[i] = 1;
    primitive["targets"].push_back({{"POSITION", file.add_positions(shift)}});
  }
  return file;
}

TEST(Morph, AppliesTheWeightsOfTheMesh) {
  GltfFile file = morphing();
  expect_square(read(file));
  file.document["meshes"][0]["weights"] = {0, 0, 0};
  expect_square(read(file));
  file.document["meshes"][0]["weights"] = {0.5, -2, 4};
  const Scene scene = read(file);
  EXPECT_EQ(scene.bounds_min, (Bounds{0.5F, -2, 4}));
  EXPECT_EQ(scene.bounds_max, (Bounds{1.5F, -1, 4}));
  EXPECT_EQ(area(scene), 1);
}

TEST(Morph, DoublesAMeshThatIsItsOwnTarget) {
  GltfFile file = square();
  file.document["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
  file.document["meshes"][0]["weights"] = {1.0};
  const Scene scene = read(file);
  EXPECT_EQ(scene.bounds_max, (Bounds{2, 2, 0}));
  EXPECT_EQ(area(scene), 4);
}

TEST(Morph, TakesANodesWeightsBeforeTheMeshs) {
  GltfFile file = morphing();
  file.document["meshes"][0]["weights"] = {1, 0, 0};
  file.add_root({{"mesh", 0}, {"weights", {0, 0, 5}}});
  file.add_root({{"mesh", 0}, {"weights", {0, 0, 0}}, {"translation", {0, 7, 0}}});
  const Scene scene = read(file);
  ASSERT_EQ(scene.meshes.size(), 3U);
  const auto first_vertex = [&](size_t mesh) {
    const size_t i = 3 * size_t(scene.indices[3 * scene.meshes[mesh].first_triangle]);
    return Bounds{scene.vertices[i], scene.vertices[i + 1], scene.vertices[i + 2]};
  };
  EXPECT_EQ(first_vertex(0), (Bounds{1, 0, 0}));
  EXPECT_EQ(first_vertex(1), (Bounds{0, 0, 5}));
  EXPECT_EQ(first_vertex(2), (Bounds{0, 7, 0}));
}

TEST(Morph, DisplacesBeforeItTransforms) {
  GltfFile file = morphing();
  file.document["nodes"][0]["scale"] = {10, 10, 10};
  file.document["meshes"][0]["weights"] = {1, 0, 0};
  EXPECT_EQ(read(file).bounds_max, (Bounds{20, 10, 0}));
}

TEST(Morph, TakesWeightsOfAnyNumber) {
  GltfFile file = morphing();
  file.document["meshes"][0]["weights"] = {0, 2};
  EXPECT_EQ(read(file).bounds_max, (Bounds{1, 3, 0}));
  file.document["meshes"][0]["weights"] = {0, 0, 2, 9, 9};
  EXPECT_EQ(read(file).bounds_max, (Bounds{1, 1, 2}));
  // A target may displace other attributes only.
  file.document["meshes"][0]["primitives"][0]["targets"][2] = {{"NORMAL", 0}};
  expect_square(read(file));
}

TEST(Morph, ReadsSparseTargets) {
  for (const bool backed : {true, false}) {
    GltfFile file = square();
    const size_t target = file.add_positions({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    const size_t places = file.add_view(raw(std::vector<uint16_t>{2}));
    const size_t values = file.add_view(raw(Floats{3, 4, 5}));
    json& accessor = file.document["accessors"][target];
    if (!backed) accessor.erase("bufferView");
    accessor["sparse"] = {{"count", 1},
                          {"indices", {{"bufferView", places}, {"componentType", kUshort}}},
                          {"values", {{"bufferView", values}}}};
    file.document["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", target}}};
    file.document["meshes"][0]["weights"] = {2};
    const Scene scene = read(file);
    EXPECT_EQ(scene.bounds_max, (Bounds{7, 9, 10}));
    EXPECT_EQ(scene.bounds_min[2], backed ? 2 : 0);
  }
}

TEST(Morph, ReadsQuantizedTargets) {
  for (const bool normalized : {true, false}) {
    GltfFile file = square();
    file.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    const std::vector<int16_t> shift = {0, 0, 32767, 0, 0, 0, 32767, 0,
                                        0, 0, 32767, 0, 0, 0, 32767, 0};
    const size_t target = file.add("accessors", {{"bufferView", file.add_view(raw(shift), 8)},
                                                 {"componentType", kShort},
                                                 {"count", 4},
                                                 {"normalized", normalized},
                                                 {"type", "VEC3"}});
    file.document["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", target}}};
    file.document["meshes"][0]["weights"] = {2};
    EXPECT_EQ(read(file).bounds_max[2], normalized ? 2 : 65534);
  }
}

TEST(Morph, MovesOnlyTheVerticesThatAreTaken) {
  GltfFile file = morphing();
  const size_t three = file.add_indices<uint8_t>({3, 2, 1}, kUbyte);
  file.document["meshes"][0]["primitives"][0]["indices"] = three;
  file.document["meshes"][0]["weights"] = {0, 0, 3};
  EXPECT_EQ(read(file).vertices, (Floats{0, 1, 3, 1, 1, 3, 1, 0, 3}));
}

TEST(Morph, RefusesBadTargetsOnlyWhereTheyAreApplied) {
  GltfFile file = morphing();
  json& mesh = file.document["meshes"][0];
  mesh["primitives"][0]["targets"][1] = {{"POSITION", 99}};
  mesh["primitives"][0]["targets"][2] = {{"POSITION", file.add_positions({1, 2, 3})}};
  mesh["weights"] = {1, 0, 0};
  EXPECT_EQ(read(file).bounds_max, (Bounds{2, 1, 0}));
  mesh["weights"] = {0, 1, 0};
  expect_error(file, SOBB_ERROR_SCENE_SYNTAX, "does not exist");
  mesh["weights"] = {0, 0, 1};
  expect_error(file, SOBB_ERROR_SCENE_SYNTAX, "displaces 1 vertices of 4");
  mesh["weights"] = {1e300, 0, 0};
  expect_error(file, SOBB_ERROR_NOT_FINITE, "meshes[0].primitives[0]");
}

TEST(Morph, HoldsItsSumsAgainstTheLimit) {
  GltfFile file;
  const size_t zeros =
      file.add("accessors", {{"componentType", kFloat}, {"count", 30'000}, {"type", "VEC3"}});
  file.add_root({{"mesh", file.add_mesh(zeros)}});
  json& mesh = file.document["meshes"][0];
  for (int i = 0; i < 20; ++i) {
    mesh["primitives"][0]["targets"].push_back({{"POSITION", zeros}});
    mesh["weights"].push_back(1);
  }
  const std::string bytes = file.glb();
  const auto read_within = [&](uint64_t limit) {
    Scene scene;
    SceneWriter writer("scene", limit, scene);
    read_gltf(bytes, writer);
  };
  EXPECT_NO_THROW(read_within(3'000'000));  // one sum, whatever the number of targets
  test::expect_failure(SOBB_ERROR_MEMORY_LIMIT, "", [&] { read_within(1'300'000); });
}

}  // namespace
}  // namespace sobb
