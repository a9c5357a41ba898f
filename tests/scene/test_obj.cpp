// SPDX-License-Identifier: Apache-2.0
// The OBJ reader: every statement that it knows, every error with its line, hostile bytes.
#include "scene/text/obj.h"

#include <gtest/gtest.h>

#include "scene/reader_testing.h"

namespace sobb {
namespace {

using reader_testing::Indices;
using reader_testing::Notes;
using reader_testing::notes_of;

const char kVertices[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 2 2\n";

Scene read(const std::string& text) { return reader_testing::read_scene(read_obj, text); }

Scene read_faces(const std::string& faces) { return read(kVertices + faces); }

void expect_error(const std::string& text, sobb_status status, const std::string& part) {
  reader_testing::expect_error(read_obj, text, status, part);
}

TEST(Obj, ReadsATriangle) {
  const Scene scene = read("v 0 0 0\nv 1.5 -2e1 .25\nv +3 4. 1e-3\nf 1 2 3\n");
  EXPECT_EQ(scene.vertices, (std::vector<float>{0, 0, 0, 1.5F, -20, 0.25F, 3, 4, 1e-3F}));
  EXPECT_EQ(scene.indices, (Indices{0, 1, 2}));
  ASSERT_EQ(scene.meshes.size(), 1U);
  EXPECT_EQ(scene.meshes[0].name, "");
}

TEST(Obj, TakesWeightsAndColours) {
  const Scene scene = read("v 0 0 0 1\nv 1 0 0 .1 .2 .3\nv 1 1 0 1 .1 .2 .3\nf 1 2 3\n");
  EXPECT_EQ(scene.vertices, (std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0}));
}

TEST(Obj, ReadsEveryFormOfCorner) {
  EXPECT_EQ(read_faces("f 1/7 2/8 3/9\n").indices, (Indices{0, 1, 2}));
  EXPECT_EQ(read_faces("f 1//7 2//8 3//9\n").indices, (Indices{0, 1, 2}));
  EXPECT_EQ(read_faces("f 1/1/1 2/-2/-2 3/3/3\n").indices, (Indices{0, 1, 2}));
  EXPECT_EQ(read_faces("f 1/ 2// 3\n").indices, (Indices{0, 1, 2}));
  EXPECT_EQ(read_faces("f -1 -2 -5\n").indices, (Indices{4, 3, 0}));
  EXPECT_EQ(read_faces("fo 1 2 3\n").indices, (Indices{0, 1, 2}));
}

TEST(Obj, NegativeIndicesCountFromTheLatestVertex) {
  const Scene scene = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -3 -2 -1\n");
  EXPECT_EQ(scene.indices, (Indices{0, 1, 2, 1, 2, 3}));
}

TEST(Obj, MakesFansOfConvexPolygons) {
  EXPECT_EQ(read("v 0 0 0\nv 2 0 0\nv 3 1 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4 5\n").indices,
            (Indices{0, 1, 2, 0, 2, 3, 0, 3, 4}));
}

TEST(Obj, SplitsConcavePolygonsByTheirArea) {
  const std::string ell = "v 4 0 0\nv 4 1 0\nv 1 1 0\nv 1 7 0\nv 0 7 0\nv 0 0 0\n";
  const Scene scene = read(ell + "f 1 2 3 4 5 6\n");  // its fan covers 22
  EXPECT_EQ(scene.indices.size(), 3U * 4);
  EXPECT_EQ(reader_testing::double_area(scene), 2 * 10);
  const Scene dart = read("v 0 0 0\nv 3 0 0\nv 1 1 0\nv 0 3 0\nf 2 3 4 1\nf 1 2 3 4\n");
  EXPECT_EQ(reader_testing::double_area(dart), 2 * 2 * 3);
}

TEST(Obj, PassesOverShortFaces) {
  for (const char* face : {"f 1 2\n", "f 1\n", "f\n", "f 1/1 2/2 # 3\n", "fo 1 1\n"}) {
    const Scene scene = read_faces(std::string(face) + "f 1 2 3\nf\n");
    EXPECT_EQ(scene.indices, (Indices{0, 1, 2}));
    ASSERT_EQ(scene.notes.size(), 1U);
    EXPECT_EQ(scene.notes[0].cause, SOBB_NOTE_SHORT_FACE);
    EXPECT_EQ(scene.notes[0].count, 2U);
  }
  EXPECT_EQ(notes_of(read_faces("f 1 2\nf 1 2 3\n")), (Notes{"1, 1, line 6: a face of 2 corners"}));
  EXPECT_EQ(notes_of(read_faces("f 1\nf 1 2 3\n")), (Notes{"1, 1, line 6: a face of 1 corner"}));
  expect_error(
      std::string(kVertices) + "f 1 2\nf 2 3\n", SOBB_ERROR_EMPTY,
      "no triangles; passed over 2 (faces of fewer than three corners): line 6: a face of 2");
}

TEST(Obj, PassesOverSurplusValuesOfVertices) {
  const Scene scene = read("v 0 0 0 1 2 3 4 5\nv 1 0 0 1 red x y z\nv 1 1 0\nf 1 2 3\n");
  EXPECT_EQ(scene.vertices, (std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0}));
  EXPECT_EQ(notes_of(scene), (Notes{"3, 2, line 1: \"5\" is more than the file declares"}));
}

TEST(Obj, FacesMayComeBeforeTheirVertices) {
  EXPECT_EQ(read("f 1 2 3\n" + std::string(kVertices) + "f 3 4 -1\n").indices,
            (Indices{0, 1, 2, 2, 3, 4}));
  // Negative indices count from the latest vertex so far, whatever has been read ahead.
  const Scene scene = read(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 5\nf -1 -2 -3\nv 4 4 4\nf -1 -2 -3\nv 5 5 5\nf -1 2 3\n");
  EXPECT_EQ(scene.indices, (Indices{0, 1, 4, 2, 1, 0, 3, 2, 1, 4, 1, 2}));
  EXPECT_EQ(scene.vertices.size(), 15U);
  expect_error("v 0 0 0\nf 1 2 4\nv 1 0 0\nv 0 1 0\n", SOBB_ERROR_INDEX,
               "line 2: corner \"4\" names no vertex: there are 3, 1 of them so far");
  expect_error("v 0 0 0\nf 1 2 3\nv 1 0 0\nv 0 x 0\n", SOBB_ERROR_SCENE_SYNTAX, "line 4: \"x\"");
}

TEST(Obj, TakesCapitals) {
  EXPECT_EQ(read("V 0 0 0\nV 1 0 0\nV 0 1 0\nG a\nF 1 2 3\nO b\nF 1 2 3\n").meshes.size(), 2U);
}

TEST(Obj, RefusesWideCharactersByName) {
  const std::string text = std::string(kVertices) + "f 1 2 3\n";
  for (const bool big : {false, true}) {
    for (const bool mark : {false, true}) {
      std::string wide = !mark ? "" : big ? "\xFE\xFF" : "\xFF\xFE";
      for (const char c : text) wide += big ? std::string{'\0', c} : std::string{c, '\0'};
      expect_error(wide, SOBB_ERROR_SCENE_UNSUPPORTED, "text in UTF-16: only ASCII and UTF-8");
    }
  }
  expect_error(std::string("\xFF\xFE\0\0v\0\0\0", 8), SOBB_ERROR_SCENE_UNSUPPORTED, "UTF-32");
  expect_error(std::string("\0\0\xFE\xFF\0\0\0v", 8), SOBB_ERROR_SCENE_UNSUPPORTED, "UTF-32");
}

TEST(Obj, KeepsDegenerateAndEqualFaces) {
  const Scene scene = read_faces("f 1 1 1\nf 1 2 2\nf 1 2 3\nf 1 2 3\n");
  EXPECT_EQ(scene.indices, (Indices{0, 0, 0, 0, 1, 1, 0, 1, 2, 0, 1, 2}));
  EXPECT_EQ(scene.degenerate_count, 2U);
}

TEST(Obj, GroupsAndObjectsAreMeshes) {
  const Scene scene = read_faces(
      "f 1 2 3\ng empty\no  Ball#1 of wool \nf 1 2 3\nf 2 3 4\nusemtl red\nf 1 2 4\ng\nf 1 2 5\n");
  ASSERT_EQ(scene.meshes.size(), 3U);
  EXPECT_EQ(scene.meshes[0].name, "");
  EXPECT_EQ(scene.meshes[0].triangle_count, 1U);
  EXPECT_EQ(scene.meshes[1].name, "Ball#1 of wool");
  EXPECT_EQ(scene.meshes[1].first_triangle, 1U);
  EXPECT_EQ(scene.meshes[1].triangle_count, 3U);
  EXPECT_EQ(scene.meshes[2].name, "");
  EXPECT_EQ(scene.meshes[2].triangle_count, 1U);
}

TEST(Obj, IgnoresOtherStatements) {
  const Scene scene = read_faces(
      "mtllib a.mtl b.mtl\nvt 0 0\nvn 0 0 1\nvp 1\ns off\nl 1 2\np 1\ncurv 0 1 \\\n1 2\n"
      "shadow_obj x\nwhat is this\n\n  \n# f 9 9 9 \\\nf 1 2 3 # f 2 3 4\n");
  EXPECT_EQ(scene.indices, (Indices{0, 1, 2}));
}

TEST(Obj, JoinsLinesAtBackslashes) {
  EXPECT_EQ(read_faces("f 1 \\\n 2 \\\r\n3\\\n 4\n").indices, (Indices{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(read("v 0 \\\n0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 \\").indices, (Indices{0, 1, 2}));
  expect_error(std::string(kVertices) + "f 1 \\\n 2 \\\n x\n", SOBB_ERROR_SCENE_SYNTAX, "line 8:");
}

TEST(Obj, TakesEveryLineEnd) {
  const std::string unix_text = std::string(kVertices) + "# comment\n\nf 1 2 3\no b\nf 2 3 4";
  for (const char* line_end : {"\n", "\r\n", "\r"}) {
    std::string text = "\xEF\xBB\xBF";  // a byte order mark is no part of the first word
    for (const char c : unix_text) text += c == '\n' ? line_end : std::string(1, c);
    const Scene scene = read(text);
    EXPECT_EQ(scene.indices, (Indices{0, 1, 2, 1, 2, 3}));
    EXPECT_EQ(scene.vertices.size(), 15U);
    EXPECT_EQ(scene.meshes.back().name, "b");
    expect_error(text + line_end + "f 1 x", SOBB_ERROR_SCENE_SYNTAX, "line 11:");
  }
}

TEST(Obj, NamesTheLineOfASyntaxError) {
  const std::string start = kVertices;
  const auto syntax = SOBB_ERROR_SCENE_SYNTAX;
  expect_error(start + "v 0 0\n", syntax, "line 6: the line ends where z should be");
  expect_error(start + "v 0 0 x\n", syntax, "line 6: \"x\" where z should be");
  expect_error(start + "v 0 0 0x10\n", syntax, "line 6: \"0x10\"");
  expect_error(start + "v 0 0 1.5.2\n", syntax, "line 6: \"1.5.2\"");
  expect_error(start + "v 0 0 +-1\n", syntax, "line 6: \"+-1\"");
  expect_error(start + "v 0,5 0 0\n", syntax, "line 6: \"0,5\" where x should be");
  expect_error(start + "v 0 0 1.5e\n", syntax, "line 6: \"1.5e\"");
  expect_error(start + "v 0 0 d1\n", syntax, "line 6: \"d1\"");
  for (const char* corner : {"x", "1x", "1/x", "1/2/x", "1/2/3/4", "/1", "1.5", "-", "1/-"}) {
    expect_error(start + "f 1 2 " + corner + "\n", syntax,
                 "line 6: \"" + std::string(corner) + "\" is no corner");
  }
}

TEST(Obj, NamesTheLineOfAnIndexError) {
  for (const char* corner : {"0", "6", "-6", "99999999999999999999", "-99999999999999999999"}) {
    expect_error(std::string(kVertices) + "\nf 1 2 " + corner, SOBB_ERROR_INDEX,
                 "line 7: corner \"" + std::string(corner) + "\"");
  }
}

TEST(Obj, RefusesCoordinatesOutOfRange) {
  const std::string start = kVertices;
  for (const char* number : {"nan", "-nan", "inf", "-Infinity", "nan(ind)", "1.#QNAN", "-1.#IND",
                             "1.#INF", "-1.#INF00", "1.#SNAN"}) {
    const std::string vertex = start + "v 0 " + number + " 0\n";
    expect_error(vertex + "f 1 2 6\n", SOBB_ERROR_NOT_FINITE, "line 7: corner 2: vertex (0, ");
    const Scene scene = read(vertex + "f 1 2 3\n");
    EXPECT_EQ(scene.bounds_max, (std::array<float, 3>{1, 1, 0})) << number;
    ASSERT_EQ(scene.notes.size(), 1U);
    EXPECT_EQ(scene.notes[0].cause, SOBB_NOTE_UNUSED_VERTEX);
    EXPECT_TRUE(scene.notes[0].first.starts_with("line 6: vertex (0, ")) << scene.notes[0].first;
    EXPECT_TRUE(scene.notes[0].first.ends_with(" is not finite")) << scene.notes[0].first;
  }
  for (const char* number : {"1e19", "-1e39", "1e400", "-1e99999999999999999999",
                             "10000000000000000000000000000000000000000000000000.5"}) {
    const std::string vertex = start + "v 0 " + number + " 0\n";
    expect_error(vertex + "f 6 2 3\n", SOBB_ERROR_TOO_LARGE, "line 7: corner 0: vertex (0, ");
    EXPECT_EQ(read(vertex + "v nan 0 0\nf 1 2 3\n").notes[0].count, 2U);
  }
}

TEST(Obj, TakesExponentsOfFortran) {
  const Scene scene = read("v 1.5D+01 -2d-1 3D0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(scene.vertices[0], 15.0F);
  EXPECT_EQ(scene.vertices[1], -0.2F);
  EXPECT_EQ(scene.vertices[2], 3.0F);
  const Scene signs = read("v 1.5+01 -25-2 3.1+e2\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(signs.vertices[0], 15.0F);
  EXPECT_EQ(signs.vertices[1], -0.25F);
  EXPECT_EQ(signs.vertices[2], 310.0F);
  for (const char* number : {"1+", "1-2-3", "1+ee5", "d", "1d", "+d1", "0,5"}) {
    const std::string text = "v " + std::string(number) + " 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    expect_error(text, SOBB_ERROR_SCENE_SYNTAX, "line 1:");
  }
}

TEST(Obj, NumbersTooSmallForFloatAreZero) {
  const std::string zeros(400, '0');
  for (const std::string& number :
       {std::string("1e-60"), std::string("-1e-400"), std::string("+1e-9999999999999999999999"),
        "0." + zeros + "1", "1" + zeros + "e-900", "0." + zeros + "1e+99"}) {
    const Scene scene = read("v " + number + " 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(scene.vertices[0], 0.0F) << number;
  }
  const std::string face = "f 1 1 1\n";
  expect_error("v 1" + zeros + " 0 0\n" + face, SOBB_ERROR_TOO_LARGE, "line 2: corner 0: vertex");
  expect_error("v 0." + zeros + "1e900 0 0\n" + face, SOBB_ERROR_TOO_LARGE, "line 2: corner 0");
}

TEST(Obj, WithoutTrianglesIsEmpty) {
  expect_error("", SOBB_ERROR_EMPTY, "no triangles");
  expect_error("\n", SOBB_ERROR_EMPTY, "no triangles");
  expect_error(kVertices, SOBB_ERROR_EMPTY, "no triangles");
}

TEST(Obj, MessagesQuoteNoControlCharacters) {
  expect_error("v \x01\xFF" + std::string(100, 'a') + " 0 0\n", SOBB_ERROR_SCENE_SYNTAX,
               "\"??" + std::string(38, 'a') + "...\"");
}

TEST(Obj, SurvivesDamage) {
  reader_testing::check_damaged(read_obj,
                                "# c\nv 0 0 0\r\nv 1 0 0 1\nv 1e1 1 -.5 \\\n 1 0 1\no a\n"
                                "f 1 2/1 -1//3\ng b\nf 1/1/1 2 3 \\\n1\n");
}

TEST(Obj, SurvivesRandomBytes) {
  reader_testing::check_random(
      read_obj, kVertices,
      {"v", "f", "g", "o", "\nf", "\nv 0 0", "1", "-1", "2", "3/1", "4//2", "0", "\\", "#", "x"});
}

TEST(Obj, ReadsALongLineInLinearTime) {
  std::string text = std::string(kVertices) + "f";
  for (int i = 0; i < 200000; ++i) text += i % 2 == 0 ? " 1" : " \\\n2";
  EXPECT_EQ(read(text).indices.size(), 3U * (200000 - 2));
}

TEST(Obj, ReadsTheMotorBike) {
  const std::string bytes = reader_testing::real_scene("motorBike.obj");
  if (bytes.empty()) GTEST_SKIP() << "SOBB_SCENES has no motorBike.obj";
  const Scene scene = read(bytes);
  EXPECT_EQ(scene.indices.size() / 3, 331653U);
  EXPECT_EQ(scene.vertices.size() / 3, 132871U);
  EXPECT_EQ(scene.meshes.size(), 67U);
}

}  // namespace
}  // namespace sobb
