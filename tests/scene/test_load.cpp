// SPDX-License-Identifier: Apache-2.0
// Loading by path: endings, files beside a scene, views, turns, and the C interface over it.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "scene/builtin/builtin.h"
#include "scene/gltf_testing.h"
#include "scene/load_testing.h"
#include "scene/model/oblique_turn.h"
#include "sobb/scene.h"

namespace sobb {
namespace {

using gltf_testing::json;
using gltf_testing::square;

class Load : public test::LoadingFiles {
 protected:
  // Writes a scene file with a camera at (1, 2, 3) that looks along -z.
  std::string write_glb_with_camera(const std::string& name) const {
    gltf_testing::GltfFile file = square();
    file.add("cameras",
             {{"type", "perspective"}, {"perspective", {{"yfov", 1.5}, {"znear", 0.1}}}});
    file.add_root({{"camera", 0}, {"translation", {1, 2, 3}}});
    return write(name, file.glb());
  }
};

constexpr const char* kView =
    R"({"eye": [1, 2, 3], "target": [4, 5, 6], "up": [0, 0, 1], "vfov_degrees": 30})";

TEST_F(Load, TellsFormatsByTheirEndings) {
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_EQ(load(write("a.obj", obj)).indices.size(), 3U);
  EXPECT_EQ(load(write("b.c.OBJ", obj)).indices.size(), 3U);
  EXPECT_EQ(load(write("a.GLB", square().glb())).indices.size(), 6U);
  expect_error(write("a.fbx", obj), SOBB_ERROR_SCENE_FORMAT, "unknown ending 'fbx'");
  std::filesystem::create_directory(path("d.obj"));
  expect_error(write("d.obj/noending", obj), SOBB_ERROR_SCENE_FORMAT, "unknown ending ''");
  expect_error("", SOBB_ERROR_SCENE_FORMAT, "unknown ending");
}

TEST_F(Load, RefusesWhatIsNoFile) {
  expect_error(path("missing.glb"), SOBB_ERROR_FILE_OPEN, "missing.glb: No such file");
  std::filesystem::create_directory(path("folder.obj"));
  expect_error(path("folder.obj"), SOBB_ERROR_FILE_OPEN, "not a regular file");
  ASSERT_EQ(mkfifo(path("pipe.ply").c_str(), 0600), 0);
  expect_error(path("pipe.ply"), SOBB_ERROR_FILE_OPEN, "not a regular file");
  for (const char* empty : {"e.glb", "e.gltf"}) {
    expect_error(write(empty, ""), SOBB_ERROR_SCENE_SYNTAX, empty);
  }
}

TEST_F(Load, ReadsBuffersBesideTheFile) {
  const gltf_testing::GltfFile file = square();
  std::filesystem::create_directories(path("a/sub"));
  const std::string gltf = write("a/b.gltf", file.gltf("sub/my%20buffer.bin"));
  expect_error(gltf, SOBB_ERROR_SCENE_REFERENCE, "sub/my%20buffer.bin");
  write("a/sub/my buffer.bin", file.binary.substr(1));
  expect_error(gltf, SOBB_ERROR_SCENE_REFERENCE, "has 59 bytes of the 60 declared");
  write("a/sub/my buffer.bin", file.binary);
  EXPECT_EQ(load(gltf).vertices, gltf_testing::kSquare);
}

TEST_F(Load, CountsTheFileAgainstTheLimit) {
  std::string triangle(84 + 50, '\0');  // binary STL
  triangle[80] = 1;
  const std::string stl = write("a.stl", triangle);
  const uint64_t size = triangle.size();
  const uint64_t arrays = 3 * 12 + 3 * 4;
  expect_error(stl, SOBB_ERROR_MEMORY_LIMIT, "a.stl", nullptr, size - 1);
  expect_error(stl, SOBB_ERROR_MEMORY_LIMIT, "a.stl", nullptr, size + arrays - 1);
  EXPECT_EQ(load_scene(stl, nullptr, size + arrays).indices.size(), 3U);
}

TEST_F(Load, MakesTheDefaultViewThatIsDocumented) {
  const Scene scene = load(write("a.glb", square().glb()));
  ASSERT_EQ(scene.views.size(), 1U);
  EXPECT_TRUE(scene.default_view);
  const double h = std::sqrt(0.5);
  EXPECT_FLOAT_EQ(scene.views[0].eye[0], float(0.5 + 2.2 * h * 0.48));
  EXPECT_FLOAT_EQ(scene.views[0].eye[2], float(2.2 * h * 0.8));
  EXPECT_EQ(scene.views[0].target[0], 0.5F);
  EXPECT_EQ(scene.views[0].up[1], 1);
  EXPECT_EQ(scene.views[0].vfov_degrees, 50);
}

TEST_F(Load, TakesViewsInTheDocumentedOrder) {
  const std::string glb = write_glb_with_camera("scene.glb");
  Scene scene = load(glb);
  ASSERT_EQ(scene.views.size(), 1U);
  EXPECT_FALSE(scene.default_view);
  EXPECT_EQ(scene.views[0].eye[2], 3);
  EXPECT_LT(scene.views[0].target[2], 3);
  EXPECT_EQ(scene.views[0].target[0], 1);
  EXPECT_FLOAT_EQ(scene.views[0].vfov_degrees, 85.943669F);

  write("cameras.json", std::string(R"({"other": 3, "scene": [)") + kView + "]}");
  scene = load(glb);
  EXPECT_EQ(scene.views[0].vfov_degrees, 30);

  const std::string mine =
      write("mine.json", std::string(R"({"scene": [)") + kView + "," + kView + "]}");
  EXPECT_EQ(load(glb, mine.c_str()).views.size(), 2U);
  const std::string others = write("others.json", "{}");
  EXPECT_EQ(load(glb, others.c_str()).views[0].vfov_degrees, 30);
}

// Another program's file of that name is no fault of the scene, as long as nobody asks for it.
TEST_F(Load, NotesForeignViewsBesideTheScene) {
  const std::string glb = write_glb_with_camera("camera.glb");
  const std::string obj = write("scene.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  for (const char* text : {R"([{"id": 0, "img_name": "a", "width": 10}])", "", "no JSON", "3",
                           "null", R"({"scene": {"fov": 3}, "camera": 7})", "\xFF\xFE{",
                           R"({"scene": [{"eye": [1, 2]}], "camera": [{}]})"}) {
    SCOPED_TRACE(text);
    const std::string views = write("cameras.json", text);
    for (const std::string& source : {glb, obj, obj + "@30", obj + "^4"}) {
      const Scene scene = load(source);
      ASSERT_EQ(scene.notes.size(), 1U);
      EXPECT_EQ(scene.notes[0].cause, SOBB_NOTE_VIEWS);
      EXPECT_EQ(scene.notes[0].count, 1U);
      EXPECT_TRUE(scene.notes[0].first.starts_with(views + ": ")) << scene.notes[0].first;
      EXPECT_EQ(scene.default_view, source != glb);
      EXPECT_EQ(scene.views.size(), 1U);
    }
    expect_error(obj, SOBB_ERROR_SCENE_SYNTAX, "cameras.json: ", views.c_str());
  }
  std::filesystem::remove(path("cameras.json"));
  std::filesystem::create_directory(path("cameras.json"));
  EXPECT_EQ(load(obj).notes[0].cause, SOBB_NOTE_VIEWS);
  std::filesystem::remove(path("cameras.json"));
  EXPECT_TRUE(load(obj).notes.empty());
}

TEST_F(Load, UnusedVerticesDoNotKeepASceneFromTurning) {
  const std::string obj =
      write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv inf 0 0\nv nan 0 0\nv 1e30 0 0\nf 1 2 3\n");
  for (const char* how : {"@30", "^4", "^4@30"}) {
    EXPECT_EQ(load(obj + how).notes[0].count, 3U) << how;
  }
}

TEST_F(Load, ReadsViewsOfBuiltInScenes) {
  const std::string mine = write("mine.json", std::string(R"({"city": [)") + kView + "]}");
  EXPECT_EQ(load("builtin:city:200@30", mine.c_str()).views[0].vfov_degrees, 30);
  EXPECT_FALSE(load("builtin:wool:200", mine.c_str()).default_view);
}

TEST_F(Load, TurnsFilesAndTheirViews) {
  const auto distance = [](const float* a, const float* b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  };
  const std::string beside = std::string(R"({"listed": [)") + kView + "]}";
  for (const char* name : {"camera.glb", "listed.glb", "plain.glb"}) {
    std::string glb = path(name);
    if (name == std::string("camera.glb")) {
      write_glb_with_camera(name);
    } else {
      glb = write(name, square().glb());
    }
    write("cameras.json", beside);
    const Scene straight = load(glb);
    const Scene turned = load(glb + "@-77.5");
    EXPECT_EQ(straight.indices, turned.indices);
    EXPECT_EQ(straight.default_view, turned.default_view);
    ASSERT_EQ(straight.views.size(), turned.views.size());
    const sobb_view& from = straight.views[0];
    const sobb_view& to = turned.views[0];
    EXPECT_EQ(from.vfov_degrees, to.vfov_degrees);
    float above_from[3];
    float above_to[3];
    for (int k = 0; k < 3; ++k) {
      above_from[k] = from.eye[k] + from.up[k];
      above_to[k] = to.eye[k] + to.up[k];
    }
    for (size_t i = 0; i < straight.vertices.size(); i += 3) {
      const float* a = &straight.vertices[i];
      const float* b = &turned.vertices[i];
      EXPECT_GT(distance(a, b), 0.1);
      EXPECT_NEAR(distance(a, from.eye), distance(b, to.eye), 1e-5);
      EXPECT_NEAR(distance(a, from.target), distance(b, to.target), 1e-5);
      EXPECT_NEAR(distance(a, above_from), distance(b, above_to), 1e-5);
      for (int k = 0; k < 3; ++k) {
        EXPECT_LE(turned.bounds_min[k], b[k]);
        EXPECT_GE(turned.bounds_max[k], b[k]);
      }
    }
  }
  // A built-in scene turns alike about the same point.
  const Scene straight = load(path("plain.glb"));
  const ObliqueTurn turn(30, {0.5, 0.5, 0});
  const Vec3 corner =
      turn.point({straight.vertices[0], straight.vertices[1], straight.vertices[2]});
  const Scene turned = load(path("plain.glb") + "@30");
  EXPECT_FLOAT_EQ(turned.vertices[0], float(corner.x));
  EXPECT_FLOAT_EQ(turned.vertices[2], float(corner.z));
  EXPECT_EQ(load(path("plain.glb") + "@0").vertices, straight.vertices);
}

TEST_F(Load, TurnsGivenViews) {
  const std::string views =
      write("views.json", std::string(R"({"city": [)") + kView + R"(], "a": [)" + kView + "]}");
  const std::string glb = write("a.glb", square().glb());
  const ObliqueTurn about_square(30, {0.5, 0.5, 0});
  const ObliqueTurn about_city = turn_of(parse_builtin("builtin:city@30"));
  for (const auto& [source, turn] : {std::pair(glb + "@30", about_square),
                                     std::pair(std::string("builtin:city:200@30"), about_city)}) {
    const sobb_view view = load(source, views.c_str()).views[0];
    const Vec3 eye = turn.point({1, 2, 3});
    EXPECT_NEAR(view.eye[0], eye.x, 1e-5) << source;
    EXPECT_NEAR(view.eye[1], eye.y, 1e-5) << source;
    EXPECT_NEAR(view.eye[2], eye.z, 1e-5) << source;
  }
}

TEST_F(Load, TellsTurnsFromPaths) {
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string straight = write("a.obj", obj);
  const std::string literal = write("b@9.obj", obj);
  EXPECT_EQ(load(literal).vertices[3], 1);
  EXPECT_NE(load(literal + "@9").vertices[3], 1);
  std::filesystem::create_directory(path("me@home"));
  write("me@home/a.obj", obj);
  EXPECT_EQ(load(path("me@home/a.obj")).vertices[3], 1);
  expect_error(write("c.obj@9", obj), SOBB_ERROR_SCENE_FORMAT, "unknown ending 'obj@9'");
  expect_error(path("none@9.obj"), SOBB_ERROR_FILE_OPEN, "none@9.obj: No such file");
  expect_error(path("none.obj@9"), SOBB_ERROR_FILE_OPEN, "none.obj: No such file");
  for (const char* wrong : {"@", "@north", "@nan", "@inf", "@361", "@-360.5", "@9@", "@9 "}) {
    expect_error(straight + wrong, SOBB_ERROR_SCENE_SYNTAX,
                 std::string(wrong) + ": after '@' comes a number of degrees");
  }
  // A vertex within 2^60 along each axis may be beyond it once turned.
  const std::string huge = write("huge.obj",
                                 "v 1152921504606846976 1152921504606846976 0\nv -1 "
                                 "1 0\nv -1152921504606846976 0 0\nf 1 2 3\n");
  EXPECT_EQ(load(huge).indices.size(), 3U);
  expect_error(huge + "@120", SOBB_ERROR_TOO_LARGE, "huge.obj@120: vertex");
}

TEST_F(Load, RefusesWrongViewsByPlace) {
  const std::string glb = write("scene.glb", square().glb());
  const auto refused = [&](const std::string& text, const std::string& part) {
    const std::string views = write("views.json", text);
    expect_error(glb, SOBB_ERROR_SCENE_SYNTAX, part, views.c_str());
    expect_error(glb, SOBB_ERROR_SCENE_SYNTAX, "views.json: ", views.c_str());
  };
  expect_error(glb, SOBB_ERROR_FILE_OPEN, "none.json", path("none.json").c_str());
  refused("", "parse error at line 1");
  refused("{\n\"scene\": [}", "line 2");
  refused("[]", "the document is not an object");
  refused(R"({"scene": 3})", "scene is not an array");
  refused(R"({"scene": [3]})", "scene[0] is not an object");
  const auto changed = [](const char* key, const json& value) {
    json view = json::parse(kView);
    view[key] = value;
    return json{{"scene", {json::parse(kView), view}}}.dump();
  };
  refused(changed("eye", {1, 2}), "scene[1].eye is not an array of three numbers");
  refused(changed("eye", {1, 2, "x"}), "scene[1].eye");
  refused(changed("target", {1, 2, 1e200}), "scene[1].target");
  refused(changed("up", nullptr), "scene[1].up");
  refused(changed("up", {3, 3, 3}), "scene[1] sees nothing");
  refused(changed("target", {1, 2, 3}), "scene[1] sees nothing");
  refused(changed("vfov_degrees", 180), "scene[1] sees nothing");
  refused(changed("vfov_degrees", "wide"), "scene[1].vfov_degrees is not a number");
}

TEST_F(Load, GivesCWhatItLoaded) {
  const std::string glb = write_glb_with_camera("scene.glb");
  sobb_scene* scene = nullptr;
  ASSERT_EQ(sobb_scene_load(glb.c_str(), nullptr, &scene), SOBB_OK) << sobb_last_error();
  sobb_scene_info info{};
  info.struct_size = sizeof info;
  ASSERT_EQ(sobb_scene_get_info(scene, &info), SOBB_OK);
  EXPECT_EQ(info.triangle_count, 2U);
  EXPECT_EQ(info.vertex_count, 4U);
  EXPECT_EQ(info.view_count, 1U);
  EXPECT_EQ(info.bounds_max[1], 1);
  sobb_scene_info shorter{};
  shorter.struct_size = offsetof(sobb_scene_info, triangle_count);
  ASSERT_EQ(sobb_scene_get_info(scene, &shorter), SOBB_OK);
  EXPECT_EQ(shorter.vertex_count, 4U);
  EXPECT_EQ(shorter.triangle_count, 0U);

  sobb_triangles triangles{};
  triangles.struct_size = sizeof triangles;
  ASSERT_EQ(sobb_scene_triangles(scene, &triangles), SOBB_OK);
  EXPECT_EQ(triangles.triangle_count, 2U);
  EXPECT_EQ(triangles.indices[5], 3U);
  sobb_mesh mesh{};
  ASSERT_EQ(sobb_scene_mesh(scene, 0, &mesh), SOBB_OK);
  EXPECT_STREQ(mesh.name, "");
  EXPECT_EQ(sobb_scene_mesh(scene, 1, &mesh), SOBB_ERROR_INVALID_ARGUMENT);
  sobb_view view{};
  ASSERT_EQ(sobb_scene_view(scene, 0, &view), SOBB_OK);
  EXPECT_EQ(sobb_scene_view(scene, 1, &view), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_scene_retain(scene), scene);
  sobb_scene_release(scene);
  sobb_scene_release(scene);
  sobb_scene_release(nullptr);
}

TEST_F(Load, GivesCItsNotes) {
  const std::string obj = write("a.obj",
                                "v 0 0 0\nv 1 0 0\nv 0 1 0 1 2 3 4 5 6\nv nan 0 0\nf 1\nf 1 2\n"
                                "f 1 2 3\n");
  sobb_scene* scene = nullptr;
  ASSERT_EQ(sobb_scene_load(obj.c_str(), nullptr, &scene), SOBB_OK) << sobb_last_error();
  sobb_scene_info info{};
  info.struct_size = sizeof info;
  ASSERT_EQ(sobb_scene_get_info(scene, &info), SOBB_OK);
  ASSERT_EQ(info.note_count, 3U);
  struct Expected {
    uint32_t cause;
    uint64_t count;
    const char* message;
    const char* name;
  };
  const Expected expected[] = {
      {SOBB_NOTE_SHORT_FACE, 2, "line 5: a face of 1 corner", "faces of fewer than three corners"},
      {SOBB_NOTE_UNUSED_VERTEX, 1, "line 4: vertex (nan, 0, 0) is not finite",
       "unusable vertices that no triangle uses"},
      {SOBB_NOTE_SURPLUS, 2, "line 3: \"5\" is more than the file declares",
       "data behind what the file declares"}};
  for (uint64_t i = 0; i < 3; ++i) {
    sobb_scene_note note{};
    note.struct_size = sizeof note;
    ASSERT_EQ(sobb_scene_get_note(scene, i, &note), SOBB_OK);
    EXPECT_EQ(note.cause, expected[i].cause);
    EXPECT_EQ(note.count, expected[i].count);
    EXPECT_STREQ(note.message, expected[i].message);
    EXPECT_STREQ(sobb_note_cause_name(note.cause), expected[i].name);
  }
  sobb_scene_note note{};
  EXPECT_EQ(sobb_scene_get_note(scene, 0, &note), SOBB_ERROR_INVALID_ARGUMENT);  // no struct_size
  note.struct_size = sizeof note;
  EXPECT_EQ(sobb_scene_get_note(scene, 3, &note), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_scene_get_note(nullptr, 0, &note), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_scene_get_note(scene, 0, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(sobb_note_cause_name(0), "unknown cause");
  EXPECT_STREQ(sobb_note_cause_name(99), "unknown cause");
  for (uint32_t cause = SOBB_NOTE_SHORT_FACE; cause <= SOBB_NOTE_VIEWS; ++cause) {
    EXPECT_STRNE(sobb_note_cause_name(cause), "unknown cause");
  }
  // A caller that was built before the notes.
  sobb_scene_info shorter{};
  shorter.struct_size = offsetof(sobb_scene_info, note_count);
  ASSERT_EQ(sobb_scene_get_info(scene, &shorter), SOBB_OK);
  EXPECT_EQ(shorter.note_count, 0U);
  sobb_scene_release(scene);
}

TEST_F(Load, GivesCItsErrors) {
  sobb_scene* scene = nullptr;
  EXPECT_EQ(sobb_scene_load(nullptr, nullptr, &scene), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_scene_load("builtin:city", nullptr, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_scene_load("builtin:none", nullptr, &scene), SOBB_ERROR_SCENE_FORMAT);
  EXPECT_NE(std::string(sobb_last_error()).find("hairball"), std::string::npos);
  EXPECT_EQ(scene, nullptr);
  sobb_scene_options options{};
  EXPECT_EQ(sobb_scene_load("builtin:city", &options, &scene), SOBB_ERROR_INVALID_ARGUMENT);
  options.struct_size = sizeof options;
  options.memory_limit = 1000;
  EXPECT_EQ(sobb_scene_load("builtin:city", &options, &scene), SOBB_ERROR_MEMORY_LIMIT);
  options.reserved = 1;
  EXPECT_EQ(sobb_scene_load("builtin:city", &options, &scene), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_scene_get_info(nullptr, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
}

}  // namespace
}  // namespace sobb
