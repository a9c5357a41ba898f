// SPDX-License-Identifier: Apache-2.0
// Primitives that KHR_draco_mesh_compression compresses; in a build without libdraco, that they are
// refused by name.
#include "scene/gltf/buffers/draco.h"

#include <gtest/gtest.h>

#include "scene/gltf_testing.h"

#ifdef SOBB_WITH_DRACO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wsign-compare"
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#pragma GCC diagnostic pop
#endif

namespace sobb {
namespace {

using namespace gltf_testing;
using Floats = std::vector<float>;

constexpr const char* kExtension = "KHR_draco_mesh_compression";

// A mesh whose one primitive is `data`, with accessors that say what it decodes to.
GltfFile compressed(const std::string& data, size_t points, size_t corners, uint32_t id = 0) {
  GltfFile file;
  file.document["extensionsUsed"] = {kExtension};
  const size_t positions =
      file.add("accessors", {{"componentType", kFloat}, {"count", points}, {"type", "VEC3"}});
  const size_t indices =
      file.add("accessors", {{"componentType", kUint}, {"count", corners}, {"type", "SCALAR"}});
  file.add_root({{"mesh", file.add_mesh(positions, int(indices))}});
  file.document["meshes"][0]["primitives"][0]["extensions"][kExtension] = {
      {"bufferView", file.add_view(data)}, {"attributes", {{"POSITION", id}}}};
  return file;
}

TEST(Draco, NamesTheExtensionOfDataThatAreNotItsOwn) {
  GltfFile file = compressed(std::string(60, 'x'), 4, 6);
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    file.document[list] = {kExtension};
    EXPECT_THROW(read(file), Error);
    reader_testing::expect_error(
        read_gltf, file.glb(),
        can_decode_draco() ? SOBB_ERROR_SCENE_SYNTAX : SOBB_ERROR_SCENE_UNSUPPORTED,
        "meshes[0].primitives[0]: KHR_draco_mesh_compression");
  }
  file.document["meshes"][0]["primitives"][0].erase("indices");
  file.document.erase("extensionsRequired");
  EXPECT_THROW(read(file), Error);
}

TEST(Draco, IsNotAskedForMeshesThatNoNodePlaces) {
  GltfFile file = square();
  json unused = compressed("x", 4, 6).document["meshes"][0];
  unused["primitives"][0]["indices"] = 1;
  file.document["meshes"].push_back(unused);
  expect_square(read(file));
}

#ifdef SOBB_WITH_DRACO

struct Coding {
  int method = draco::MESH_EDGEBREAKER_ENCODING;
  int speed = 5;
  int bits = 14;  // of positions; 0 for floats as they are
  bool attributes = false;
};

std::string encoded(const Floats& points, const std::vector<uint32_t>& indices,
                    const Coding& coding) {
  draco::TriangleSoupMeshBuilder builder;
  const auto faces = int(indices.size() / 3);
  builder.Start(faces);
  const int positions =
      builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  int normals = -1;
  int texture = -1;
  if (coding.attributes) {
    normals = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
    texture = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
  }
  for (int face = 0; face < faces; ++face) {
    const auto corner = [&](int k) { return &points[3 * size_t(indices[size_t(3 * face + k)])]; };
    const draco::FaceIndex at(static_cast<uint32_t>(face));
    builder.SetAttributeValuesForFace(positions, at, corner(0), corner(1), corner(2));
    if (!coding.attributes) continue;
    const float normal[3] = {0, 0, 1};
    builder.SetAttributeValuesForFace(normals, at, normal, normal, normal);
    builder.SetAttributeValuesForFace(texture, at, corner(0), corner(1), corner(2));
  }
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(coding.method);
  encoder.SetSpeedOptions(coding.speed, coding.speed);
  if (coding.bits != 0) {
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, coding.bits);
  }
  if (coding.attributes) {
    encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, 8);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 10);
  }
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  return {buffer.data(), buffer.size()};
}

const std::vector<uint32_t> kSquareIndices = {0, 1, 2, 0, 2, 3};

std::string encoded_square(const Coding& coding = {}) {
  return encoded(kSquare, kSquareIndices, coding);
}

// A grid of unit squares, 59 by 49, on a wave.
struct Grid {
  Floats points;
  std::vector<uint32_t> indices;

  Grid() {
    for (int i = 0; i < 3000; ++i) {
      points.insert(points.end(), {float(i % 60), float(i / 60), float(i * i % 7)});
    }
    for (uint32_t row = 0; row < 49; ++row) {
      for (uint32_t i = 60 * row; i + 1 < 60 * row + 60; ++i) {
        indices.insert(indices.end(), {i, i + 1, i + 60, i + 60, i + 1, i + 61});
      }
    }
  }
  double area() const {
    GltfFile file;
    const size_t positions = file.add_positions(points);
    file.add_root({{"mesh", file.add_mesh(positions, int(file.add_indices(indices, kUint)))}});
    return gltf_testing::area(read(file));
  }
};

TEST(Draco, DecodesEveryMethodAndSpeed) {
  const Grid grid;
  const double exact = grid.area();
  for (const int method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
    for (int speed = 0; speed <= 10; ++speed) {
      for (const bool attributes : {false, true}) {
        for (const int bits : {0, 11, 16}) {
          if (bits == 0 && method == draco::MESH_EDGEBREAKER_ENCODING) continue;
          SCOPED_TRACE(testing::Message()
                       << method << ' ' << speed << ' ' << attributes << ' ' << bits);
          const std::string data =
              encoded(grid.points, grid.indices, {method, speed, bits, attributes});
          const Scene scene = read(compressed(data, 3000, grid.indices.size()));
          EXPECT_EQ(scene.indices.size(), grid.indices.size());
          EXPECT_NEAR(area(scene), exact, bits == 0 ? 1e-3 : exact * 0.02);
          EXPECT_NEAR(scene.bounds_max[0], 59, 0.05);
          EXPECT_NEAR(scene.bounds_max[1], 49, 0.05);
        }
      }
    }
  }
}

TEST(Draco, NeedsNeitherIndicesNorACountThatIsRight) {
  GltfFile file = compressed(encoded_square(), 4, 6);
  expect_square(read(file));
  file.document["extensionsRequired"] = {kExtension};
  expect_square(read(file));
  for (const int count : {1, 0}) {
    file.document["accessors"][0]["count"] = count;
    file.document["accessors"][1]["count"] = count;
    expect_square(read(file));
  }
  json& primitive = file.document["meshes"][0]["primitives"][0];
  primitive.erase("indices");
  expect_square(read(file));
  primitive["mode"] = 5;  // what is decoded are triangles all the same
  expect_square(read(file));
  primitive.erase("mode");
  expect_square(read(file));
}

TEST(Draco, IsTakenBeforeTheElementsThatABufferHasToo) {
  GltfFile file = compressed(encoded_square(), 4, 6);
  const size_t other = file.add_view(raw(Floats(12, 7.0F)));
  file.document["accessors"][0]["bufferView"] = other;
  expect_square(read(file));
}

TEST(Draco, FindsPositionsByTheirId) {
  const std::string data = encoded_square({draco::MESH_EDGEBREAKER_ENCODING, 5, 14, true});
  expect_square(read(compressed(data, 4, 6, 0)));
  expect_error(compressed(data, 4, 6, 2), SOBB_ERROR_SCENE_SYNTAX, "no positions of three numbers");
  expect_error(compressed(data, 4, 6, 9), SOBB_ERROR_SCENE_SYNTAX, kExtension);
}

TEST(Draco, DecodesIntegersAndNormalisesThem) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(1);
  const int positions =
      builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_UINT8);
  const uint8_t corners[3][3] = {{0, 0, 0}, {255, 0, 0}, {0, 255, 0}};
  builder.SetAttributeValuesForFace(positions, draco::FaceIndex(0), corners[0], corners[1],
                                    corners[2]);
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::Encoder encoder;
  draco::EncoderBuffer buffer;
  ASSERT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  GltfFile file = compressed({buffer.data(), buffer.size()}, 3, 3);
  json& accessor = file.document["accessors"][0];
  accessor["componentType"] = kUbyte;
  EXPECT_EQ(area(read(file)), 255 * 255 / 2.0);
  accessor["normalized"] = true;
  EXPECT_EQ(area(read(file)), 0.5);
}

TEST(Draco, IsDisplacedByMorphTargets) {
  GltfFile file = compressed(encoded_square(), 4, 6);
  json& mesh = file.document["meshes"][0];
  mesh["primitives"][0]["targets"] = {{{"POSITION", file.add_positions(Floats(12, 1.0F))}}};
  mesh["weights"] = {3};
  EXPECT_EQ(read(file).bounds_max, (std::array<float, 3>{4, 4, 3}));
}

TEST(Draco, DecodesOncePerMesh) {
  GltfFile file = compressed(encoded_square(), 4, 6);
  file.add_root({{"mesh", 0}, {"translation", {5, 0, 0}}});
  const Scene scene = read(file);
  EXPECT_EQ(area(scene), 2);
  EXPECT_EQ(scene.meshes.size(), 2U);
}

TEST(Draco, RefusesWhatCannotBe) {
  const auto refused = [](const char* pointer, const json& value, const std::string& part) {
    GltfFile file = compressed(encoded_square(), 4, 6);
    file.document[json::json_pointer("/meshes/0/primitives/0/extensions")][kExtension]
                 [json::json_pointer(pointer)] = value;
    expect_error(file, SOBB_ERROR_SCENE_SYNTAX, part);
  };
  refused("/bufferView", 9, "KHR_draco_mesh_compression names no bufferView, 9");
  refused("/bufferView", "x", "KHR_draco_mesh_compression.bufferView is not an integer");
  refused("/attributes", json::object(),
          "KHR_draco_mesh_compression.attributes.POSITION is missing");
  refused("/attributes", 3, "KHR_draco_mesh_compression.attributes is not an object");
  // A point cloud, and a bitstream of another version.
  std::string data = encoded_square();
  data[7] = 0;
  expect_error(compressed(data, 4, 6), SOBB_ERROR_SCENE_SYNTAX, "no mesh of Draco 2.2");
  data = encoded_square();
  data[6] = 1;
  expect_error(compressed(data, 4, 6), SOBB_ERROR_SCENE_SYNTAX, "no mesh of Draco 2.2");
}

TEST(Draco, HoldsWhatItDecodesAgainstTheLimit) {
  const Grid grid;
  const std::string bytes =
      compressed(encoded(grid.points, grid.indices, {}), 3000, grid.indices.size()).glb();
  const auto read_within = [&](uint64_t limit) {
    Scene scene;
    SceneWriter writer("scene", limit, scene);
    read_gltf(bytes, writer);
  };
  EXPECT_NO_THROW(read_within(20'000'000));
  test::expect_failure(SOBB_ERROR_MEMORY_LIMIT, "", [&] { read_within(2'000'000); });
}

// Data that say they are a thousand million triangles.
TEST(Draco, RefusesABombBeforeItTakesMemory) {
  for (const char* method : {"\x01", "\x00"}) {
    std::string data("DRACO\x02\x02\x01", 8);
    data += std::string(method, 1) + std::string(2, '\0');
    if (data[8] == 1) data += '\0';                  // the standard traversal
    data += std::string("\x80\x94\xEB\xDC\x03", 5);  // vertices, or faces
    data += std::string("\x80\x94\xEB\xDC\x03", 5);  // faces, or points
    data += std::string(200, '\x01');
    GltfFile file = compressed(data, 1'000'000'000, 3'000'000'000);
    reader_testing::expect_error(read_gltf, file.glb(), SOBB_ERROR_MEMORY_LIMIT,
                                 "libdraco may take");
  }
}

TEST(Draco, SurvivesDamagedData) {
  for (const int speed : {0, 10}) {
    const std::string data = encoded_square({draco::MESH_EDGEBREAKER_ENCODING, speed, 8, true});
    for (size_t size = 0; size < data.size(); ++size) {
      reader_testing::read_hostile(read_gltf, compressed(data.substr(0, size), 4, 6).glb());
    }
    for (size_t i = 0; i < data.size(); ++i) {
      for (const int change : {1, 2, 4, 8, 16, 32, 64, 128, 255}) {
        std::string bad = data;
        bad[i] = char(bad[i] ^ change);
        reader_testing::read_hostile(read_gltf, compressed(bad, 4, 6).glb());
      }
    }
  }
}

#else

TEST(Draco, TakesTheElementsThatABufferHasToo) {
  GltfFile file = square();
  file.document["meshes"][0]["primitives"][0]["extensions"][kExtension] = {
      {"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
  expect_square(read(file));
}

#endif

}  // namespace
}  // namespace sobb
