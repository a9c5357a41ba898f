// SPDX-License-Identifier: Apache-2.0
// Malformed items of a glTF cost the scene only where a triangle needs them.
#include "scene/gltf/document/faults.h"

#include <gtest/gtest.h>

#include "scene/gltf_testing.h"

namespace sobb {
namespace {

using namespace gltf_testing;

constexpr sobb_status kSyntax = SOBB_ERROR_SCENE_SYNTAX;

// Expects that the square loads with one more element in an array of its document, and that the
// element is noted with `part`.
void expect_noted(const char* array, const json& element, const std::string& part) {
  GltfFile file = square();
  file.add(array, element);
  SCOPED_TRACE(std::string(array) + ' ' + element.dump());
  const Scene scene = read(file);
  expect_square(scene, 1);
  expect_note(scene, SOBB_NOTE_UNUSED_ITEM, 1, part);
}

TEST(Faults, OfUnusedItemsAreNoted) {
  const json good = {{"componentType", kFloat}, {"count", 3}, {"type", "VEC3"}};
  const auto accessor = [&](const char* key, const json& value) {
    json element = good;
    element[key] = value;
    return element;
  };
  for (const json& element : {json(3), json("x"), json::array(), json(nullptr)}) {
    expect_noted("accessors", element, "accessors[2] is not an object");
    expect_noted("meshes", element, "meshes[1] is not an object");
    expect_noted("nodes", element, "nodes[1] is not an object");
    expect_noted("cameras", element, "cameras[0] is not an object");
    expect_noted("bufferViews", element, "bufferViews[2] is not an object");
    expect_noted("scenes", element, "scenes[1] is not an object");
  }
  expect_noted("accessors", json::object(), "accessors[2].componentType is missing");
  expect_noted("accessors", accessor("type", "VEC5"), "accessors[2] has an unknown type");
  expect_noted("accessors", accessor("type", 3), "accessors[2].type is not a string");
  expect_noted("accessors", accessor("componentType", 5127 + 10), "accessors[2] has an unknown");
  expect_noted("accessors", accessor("componentType", "x"), "accessors[2].componentType");
  expect_noted("accessors", accessor("count", -1), "accessors[2].count");
  expect_noted("accessors", accessor("count", 1.5), "accessors[2].count is not an integer");
  expect_noted("accessors", accessor("bufferView", 99), "accessors[2] names no bufferView, 99");
  expect_noted("accessors", accessor("bufferView", 2), "accessors[2] names no bufferView, 2");
  expect_noted("accessors", accessor("sparse", 3), "accessors[2].sparse is not an object");
  expect_noted("accessors", accessor("sparse", json::object()), "accessors[2].sparse.count");
  expect_noted("bufferViews", json::object(), "bufferViews[2].buffer is missing");
  expect_noted("bufferViews", {{"buffer", -1}, {"byteLength", 1}}, "bufferViews[2].buffer");
  const json lens = {
      {"buffer", 0}, {"byteLength", 3}, {"extensions", {{"EXT_meshopt_compression", 3}}}};
  expect_noted("bufferViews", lens, "bufferViews[2].EXT_meshopt_compression is not an object");
  expect_noted("cameras", json::object(), "cameras[0].type is missing");
  expect_noted("cameras", {{"type", "perspective"}}, "cameras[0].perspective is not an object");
  expect_noted("cameras", {{"type", "perspective"}, {"perspective", json::object()}}, "yfov");
  expect_noted("meshes", {{"primitives", 3}}, "meshes[1].primitives is not an array");
  expect_noted("meshes", {{"primitives", {3}}}, "meshes[1].primitives[0] is not an object");
  expect_noted("meshes", {{"primitives", {{{"attributes", {{"POSITION", 9}}}}}}}, "accessors[9]");
  const json indices = {{"attributes", {{"POSITION", 0}}}, {"indices", 9}};
  expect_noted("meshes", {{"primitives", {indices}}}, "accessors[9], which does not exist");
  expect_noted("nodes", {{"mesh", "x"}}, "nodes[1].mesh is not an integer");
  expect_noted("nodes", {{"matrix", {1, 2}}}, "nodes[1].matrix has a wrong length");
  expect_noted("scenes", {{"nodes", {-5}}}, "scenes[1].nodes");
}

TEST(Faults, OfWhatIsNeverReadAreNotLookedFor) {
  const json nonsense = {3, "x", nullptr, {{"source", -1}}, json::array()};
  for (const char* array : {"images", "textures", "samplers", "materials", "skins", "animations"}) {
    GltfFile file = square();
    for (const json& value : {nonsense, json(3), json::object()}) {
      file.document[array] = value;
      expect_square(read(file));
    }
  }
  GltfFile file = square();
  file.document["nodes"][0]["skin"] = "x";
  file.document["meshes"][0]["primitives"][0]["material"] = -7;
  file.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = "x";
  file.document["accessors"][0]["min"] = {"x"};
  file.document["accessors"][0]["name"] = 7;
  file.document["bufferViews"][0]["target"] = "x";
  file.document["buffers"][0]["name"] = 7;
  expect_square(read(file));
}

TEST(Faults, OfItemsThatTrianglesNeedAreErrors) {
  const auto refused = [](const char* pointer, const json& value, const std::string& part) {
    GltfFile file = square();
    file.document[json::json_pointer(pointer)] = value;
    SCOPED_TRACE(pointer);
    expect_error(file, kSyntax, part);
  };
  refused("/accessors/0/type", 3, "accessors[0].type is not a string");
  refused("/accessors/1", 3, "accessors[1] is not an object");
  refused("/bufferViews/0", 3, "bufferViews[0] is not an object");
  refused("/bufferViews/1/byteLength", "x", "bufferViews[1].byteLength is not an integer");
  refused("/meshes/0/primitives", 3, "meshes[0].primitives is not an array");
  refused("/nodes/0/translation", {1, 2}, "nodes[0].translation has a wrong length");
  refused("/scenes/0/nodes", {"x"}, "scenes[0].nodes is not an integer");
}

TEST(Faults, OfCamerasCostTheView) {
  GltfFile file = square();
  file.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", "x"}}}});
  file.add_root({{"camera", 0}});
  expect_note(read(file), SOBB_NOTE_UNUSED_ITEM, 1, "cameras[0].perspective.yfov is not a number");
  file.add_root({{"camera", 9}});
  file.add_root({{"camera", "x"}});
  const Scene scene = read(file);
  expect_square(scene, 1);
  EXPECT_EQ(note_of(scene, SOBB_NOTE_UNUSED_ITEM).count, 3U);
  file.document["cameras"] = 3;
  expect_note(read(file), SOBB_NOTE_UNUSED_ITEM, 4, "nodes[1] names no camera, 0");
  file = square();
  file.document["cameras"] = 3;
  expect_note(read(file), SOBB_NOTE_UNUSED_ITEM, 1, "cameras is not an array");
  // A camera without the members that views do not need is a camera.
  file = square();
  file.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}}}});
  file.add("cameras", {{"type", "orthographic"}});
  file.add("cameras", {{"type", "fisheye"}});
  for (int i = 0; i < 3; ++i) file.add_root({{"camera", i}});
  expect_square(read(file));
}

TEST(Faults, OfEmptyPrimitivesCostThose) {
  GltfFile file = square();
  json empty = {{"componentType", kFloat}, {"count", 0}, {"type", "VEC3"}};
  const size_t none = file.add("accessors", empty);
  json& primitives = file.document["meshes"][0]["primitives"];
  primitives.push_back({{"attributes", {{"POSITION", none}}}});
  expect_note(read(file), SOBB_NOTE_UNUSED_ITEM, 1, "accessors[2] has no elements");
  empty["type"] = "SCALAR";
  empty["componentType"] = kUshort;
  const size_t no_index = file.add("accessors", empty);
  primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"indices", no_index}});
  primitives.push_back({{"attributes", json::object()}});
  primitives.push_back(json::object());
  const Scene scene = read(file);
  expect_square(scene, 1);
  EXPECT_EQ(note_of(scene, SOBB_NOTE_UNUSED_ITEM).count, 2U);
  for (int i = 1; i < 5; ++i) primitives.erase(1);
  primitives[0]["indices"] = no_index;
  expect_error(file, SOBB_ERROR_EMPTY, "no triangles");
}

TEST(Faults, OfCornersWithoutATriangleCostThose) {
  GltfFile file = square();
  json& primitives = file.document["meshes"][0]["primitives"];
  for (const size_t corners : {1, 2}) {
    for (const int mode : {4, 5, 6}) {
      const std::vector<uint16_t> indices(corners);
      const size_t few = file.add_indices<uint16_t>(indices, kUshort);
      primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"indices", few}, {"mode", mode}});
    }
  }
  const size_t eight = file.add_indices<uint16_t>({0, 1, 2, 0, 2, 3, 1, 2}, kUshort);
  primitives[0]["indices"] = eight;
  const Scene scene = read(file);
  expect_square(scene, 1);
  expect_note(scene, SOBB_NOTE_SHORT_FACE, 7, "meshes[0].primitives[0]: its last corners");
}

TEST(Faults, OfEncodingsAreNamed) {
  const std::string text = square().gltf("data:,");
  for (const bool little : {true, false}) {
    std::string wide = little ? "\xFF\xFE" : "\xFE\xFF";
    for (const char c : text) wide += little ? std::string{c, '\0'} : std::string{'\0', c};
    reader_testing::expect_error(read_gltf, wide, SOBB_ERROR_SCENE_UNSUPPORTED, "UTF-16");
  }
  reader_testing::expect_error(read_gltf, "\xEF\xBB\xBF" + text, SOBB_ERROR_SCENE_REFERENCE,
                               "buffer 0 has 0 bytes");  // a byte order mark of UTF-8
}

TEST(Faults, OfVersionsAreNamed) {
  const auto refused = [](const std::string& text, const std::string& part) {
    reader_testing::expect_error(read_gltf, text, SOBB_ERROR_SCENE_UNSUPPORTED, part);
  };
  // Documents of glTF 1.0 name their elements.
  const std::string named = R"("scene":"s","nodes":{"n":{}},"meshes":{"m":{}}})";
  refused(R"({"asset":{"version":"1.0"},)" + named, "glTF 1.0: only 2.x is read");
  refused(R"({"asset":{"version":"1.0.1"},)" + named, "glTF 1.0.1: only 2.x is read");
  refused(R"({"asset":{"version":1},)" + named, "glTF 1.0: only 2.x is read");
  refused(R"({"asset":{"version":1.0},)" + named, "glTF 1.0: only 2.x is read");
  refused(R"({"asset":{},)" + named, "glTF 1.0: only 2.x is read");
  refused("{" + named, "glTF 1.0: only 2.x is read");
  refused(R"({"asset":{"version":"0.8"}})", "glTF 0.8: only 2.x is read");
  refused(R"({"asset":{"version":"3.0"}})", "glTF 3.0: only 2.x is read");
  refused(R"({"asset":{"version":"20"}})", "glTF 20: only 2.x is read");
  refused(R"({"asset":{"version":1.0},"extensionsRequired":["KHR_binary_glTF"]})", "glTF 1.0");
  for (const json& version :
       {json("2.0"), json("2"), json("2.1"), json("2.0.1"), json(2), json(2.0)}) {
    GltfFile file = square();
    file.document["asset"]["version"] = version;
    expect_square(read(file));
  }
}

}  // namespace
}  // namespace sobb
