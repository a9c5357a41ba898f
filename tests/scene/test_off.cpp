// SPDX-License-Identifier: Apache-2.0
// The OFF reader: keywords and their extras, every error with its line, hostile bytes.
#include "scene/text/off.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/reader_testing.h"

namespace sobb {
namespace {

using reader_testing::Indices;
using reader_testing::Notes;
using reader_testing::notes_of;

const char kSquare[] = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n3 0 1 2\n3 0 2 3\n";

Scene read(const std::string& text) { return reader_testing::read_scene(read_off, text); }

void expect_error(const std::string& text, sobb_status status, const std::string& part) {
  reader_testing::expect_error(read_off, text, status, part);
}

TEST(Off, ReadsASquare) {
  const Scene scene = read(kSquare);
  EXPECT_EQ(scene.vertices, (std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0.5F}));
  EXPECT_EQ(scene.indices, (Indices{0, 1, 2, 0, 2, 3}));
}

TEST(Off, TakesCommentsBlankLinesAndCountsOnTheFirstLine) {
  const Scene scene = read(
      "# made by hand\n\nOFF 4 1 4 # counts\r\n\r\n0 0 0\r\n 1 0 0 # b\r\n#\r\n1 1 0\r\n0 1 0\r\n"
      "4 0 1 2 3\r\n\r\n");
  EXPECT_EQ(scene.indices, (Indices{0, 1, 2, 0, 2, 3}));
}

TEST(Off, KeepsDegenerateFacesAndMakesFans) {
  const Scene scene = read("OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n3 1 1 1\n5 0 1 2 2 2\n3 0 1 2");
  EXPECT_EQ(scene.indices, (Indices{1, 1, 1, 0, 1, 2, 0, 2, 2, 0, 2, 2, 0, 1, 2}));
}

TEST(Off, PassesOverColoursNormalsAndTextureCoordinates) {
  const auto square = [](const std::string& keyword, const std::string& extras) {
    std::string text = keyword + "\n3 2 0\n";
    for (const char* vertex : {"0 0 0", "1 0 0", "0 1 0"}) text += vertex + extras + "\n";
    return text + "3 0 1 2 255 0 0\n3 2 1 0 .5 .5 .5 1\n";
  };
  for (const auto& [keyword, extras] :
       std::vector<std::pair<std::string, std::string>>{{"COFF", " 255 0 0"},
                                                        {"COFF", " .1 .2 .3 1"},
                                                        {"NOFF", " 0 0 1"},
                                                        {"STOFF", " .5 .5"},
                                                        {"CNOFF", " 0 0 1 1 1 1 1"},
                                                        {"NCOFF", " 0 0 1 1 1 1"},
                                                        {"STCNOFF", " 0 0 0 0 1 1 1 1"}}) {
    EXPECT_EQ(read(square(keyword, extras)).indices, (Indices{0, 1, 2, 2, 1, 0})) << keyword;
  }
  // Colours that the keyword does not announce, and any after faces, whatever they are.
  EXPECT_EQ(notes_of(read(square("OFF", " 1 0 0"))),
            (Notes{"3, 9, line 3: \"1\" is more than the file declares"}));
  EXPECT_EQ(notes_of(read(square("NOFF", " 1 2 3 4"))),
            (Notes{"3, 3, line 3: \"4\" is more than the file declares"}));
  EXPECT_EQ(notes_of(read(square("COFF", " 1 2 red"))), Notes{});
  EXPECT_EQ(notes_of(read(square("NOFF", ""))), Notes{});
}

TEST(Off, TakesEveryBeginning) {
  const std::string rest = "\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  for (const char* begin : {"OFF4 2 0",
                            "OFF4 2",
                            "OFF 4 2",
                            "OFF\n4 2",
                            "OFF\n4 2 # no edges",
                            "off\n4 2 0",
                            "Off4 2 0",
                            "4 2 0",
                            "4 2",
                            "# c\n\n4 2 0",
                            "OFF\n4\n2\n0",
                            "OFF\n4\n2",
                            "OFF\r4 2 0",
                            "OFF\r\n4 2 0",
                            "\xEF\xBB\xBFOFF\n4 2 0",
                            "COFF4 2 0",
                            "noff\n4 2 0",
                            "coff\n4 2 0",
                            "\n \nOFF\n\n# c\n4 2 0",
                            "OFF\n4 2 5"}) {
    const Scene scene = read(begin + rest);
    EXPECT_EQ(scene.indices, (Indices{0, 1, 2, 0, 2, 3})) << begin;
    EXPECT_EQ(scene.vertices.size(), 12U) << begin;
    EXPECT_EQ(notes_of(scene), Notes{}) << begin;
  }
  EXPECT_EQ(notes_of(read("OFF\n4 2 0 7" + rest)),
            (Notes{"3, 1, line 2: \"7\" is more than the file declares"}));
}

TEST(Off, PassesOverShortFacesAndWhatFollowsTheLast) {
  const std::string vertices = "OFF\n3 4 0\n0 0 0\n1 0 0\n0 1 0\n";
  const Scene scene = read(vertices + "2 0 1\n3 0 1 2\n0\n1 2 9 9 9\n4 surplus\nwords\n");
  EXPECT_EQ(scene.indices, (Indices{0, 1, 2}));
  EXPECT_EQ(notes_of(scene), (Notes{"1, 3, line 6: a face of 2 corners",
                                    "3, 3, line 10: \"4\" is more than the file declares"}));
}

TEST(Off, UnusableVerticesThatNoFaceUsesAreCounted) {
  const std::string text = "OFF\n5 1 0\n0 0 0\n1 0 0\n1e30 nan inf\n0 1 0\n0 -1e19 0\n3 0 1 ";
  const Scene scene = read(text + "3");
  EXPECT_EQ(scene.bounds_max, (std::array<float, 3>{1, 1, 0}));
  EXPECT_EQ(notes_of(scene), (Notes{"2, 2, line 5: vertex (1e+30, nan, inf) is not finite"}));
  for (const float x : scene.vertices) EXPECT_LE(std::fabs(x), 1);
  expect_error(text + "2", SOBB_ERROR_NOT_FINITE, "line 8: corner 2: vertex (1e+30, nan, inf)");
  expect_error(text + "4", SOBB_ERROR_TOO_LARGE,
               "line 8: corner 2: vertex (0, -1e+19, 0) is beyond");
}

TEST(Off, RefusesOtherFormsByName) {
  const auto unsupported = SOBB_ERROR_SCENE_UNSUPPORTED;
  expect_error("OFF BINARY\n\x01\x02", unsupported, "line 1: binary OFF");
  expect_error("NOFF  BINARY\n", unsupported, "line 1: binary OFF");
  expect_error("4OFF\n1 1 1\n", unsupported, "4OFF");
  expect_error("nOFF\n3\n1 1 1\n", unsupported, "nOFF");
  expect_error("ST4nOFF\n3\n1 1 1\n", unsupported, "ST4nOFF");
}

TEST(Off, NamesTheLineOfASyntaxError) {
  const auto syntax = SOBB_ERROR_SCENE_SYNTAX;
  for (const char* keyword : {"", "\n\n", "of", "XOFF", "CCOFF", "ply", "-4 2 0", "solid off"}) {
    expect_error(keyword, syntax, "where OFF should be");
  }
  expect_error("OFF490 1 0", syntax, "490 vertices and 1 faces do not fit");
  expect_error("OFFX", syntax, "\"X\" where the count of vertices");
  const std::string vertices = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  expect_error("OFF", syntax, "line 1:");
  expect_error("OFF\n3\n", syntax, "line 2: the line ends where the count of faces");
  expect_error("OFF\n3 1 x\n", syntax, "line 2: \"x\" where the count of edges");
  expect_error("OFF\n3 -1 0\n", syntax, "line 2: \"-1\" where the count of faces");
  expect_error("OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", syntax, "line 4: the line ends");
  expect_error("OFF\n3 1 0\n0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n", syntax, "line 4: \"x\"");
  expect_error(vertices + "4 0 1 2\n", syntax, "line 6: the line ends");
  expect_error(vertices + "#       \n\n", syntax, "line 7: the file ends before face 0 of 1");
  expect_error("OFF\n3 1 0\n0 0 0\n0 0 0\n#             \n", syntax, "before vertex 2 of 3");
}

TEST(Off, NamesTheLineOfOtherErrors) {
  const std::string vertices = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  for (const char* index : {"3", "-1", "99999999999999999999"}) {
    expect_error(vertices + "3 0 1 " + index, SOBB_ERROR_INDEX,
                 "line 6: there is no vertex " + std::string(index));
  }
  expect_error("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", SOBB_ERROR_EMPTY, "no triangles");
  expect_error("OFF\n0 0 0\n", SOBB_ERROR_EMPTY, "no triangles");
}

TEST(Off, RefusesHugeCountsAtOnce) {
  const auto syntax = SOBB_ERROR_SCENE_SYNTAX;
  expect_error("OFF\n4000000000 1 0\n0 0 0\n", syntax, "do not fit");
  expect_error("OFF\n3 4000000000 0\n0 0 0\n", syntax, "do not fit");
  expect_error("OFF\n4294967296 1 0\n0 0 0\n", syntax, "more than can be");
  expect_error("OFF\n99999999999999999999999 1 0\n0 0 0\n", syntax, "more than can be");
  expect_error("OFF\n1 1 0\n0 0 0\n4000000000 0 0 0\n", syntax, "line 4: the line ends");
}

TEST(Off, SurvivesDamage) {
  reader_testing::check_damaged(read_off, kSquare);
  reader_testing::check_damaged(read_off,
                                "STCNOFF # x\n3 1 0\n0 0 0 0 0 1 1 1 1 1 1\n"
                                "1 0 0 0 0 1 1 1 1 1 1 1\n0 1 0 0 0 1 1 1 1 1 1\n3 0 1 2 1 1");
}

TEST(Off, SurvivesRandomBytes) {
  const std::vector<std::string> words = {"0", "1", "2", "3", "-1", "1e9", "\n3 0 1 2", "#", "\\"};
  reader_testing::check_random(read_off, "OFF\n", words);
  reader_testing::check_random(read_off, "OFF\n2 2 0\n0 0 0\n", words);
}

}  // namespace
}  // namespace sobb
