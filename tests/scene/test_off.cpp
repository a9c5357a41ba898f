// SPDX-License-Identifier: Apache-2.0
// The OFF reader: keywords and their extras, every error with its line, hostile bytes.
#include "scene/text/off.h"

#include <gtest/gtest.h>

#include "scene/reader_testing.h"

namespace sobb {
namespace {

using reader_testing::Indices;

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
  const Scene scene = read("OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n3 1 1 1\n5 0 1 2 1 0\n3 0 1 2");
  EXPECT_EQ(scene.indices, (Indices{1, 1, 1, 0, 1, 2, 0, 2, 1, 0, 1, 0, 0, 1, 2}));
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
  const auto syntax = SOBB_ERROR_SCENE_SYNTAX;
  expect_error(square("OFF", " 1"), syntax, "line 3: \"1\" where the line's end");
  expect_error(square("NOFF", " 1 2"), syntax, "line 3: the line ends");
  expect_error(square("NOFF", " 1 2 3 4"), syntax, "line 3: \"4\"");
  expect_error(square("COFF", " 1 2 red"), syntax, "line 3: \"red\"");
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
  for (const char* keyword : {"", "\n\n", "of", "XOFF", "CCOFF", "OFF490 1 0", "4 2 0"}) {
    expect_error(keyword, syntax, "where OFF should be");
  }
  const std::string vertices = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  expect_error("OFF", syntax, "line 1:");
  expect_error("OFF\n3 1\n", syntax, "line 2: the line ends where the count of edges");
  expect_error("OFF\n3 -1 0\n", syntax, "line 2: \"-1\" where the count of faces");
  expect_error("OFF\n3 1 0 7\n0 0 0\n", syntax, "line 2: \"7\"");
  expect_error("OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", syntax, "line 4: the line ends");
  expect_error("OFF\n3 1 0\n0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n", syntax, "line 4: \"x\"");
  expect_error(vertices + "2 0 1  \n", syntax, "line 6: a face of 2 corners");
  expect_error(vertices + "4 0 1 2\n", syntax, "line 6: the line ends");
  expect_error(vertices + "3 0 1 2 red\n", syntax, "line 6: \"red\" where a colour");
  expect_error(vertices + "3 0 1 2\n3 0 1 2\n", syntax, "line 7: text after the last of 1 faces");
  expect_error(vertices + "#       \n\n", syntax, "line 7: the file ends before face 0 of 1");
  expect_error("OFF\n3 1 0\n0 0 0\n0 0 0\n#             \n", syntax, "before vertex 2 of 3");
}

TEST(Off, NamesTheLineOfOtherErrors) {
  const std::string vertices = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  for (const char* index : {"3", "-1", "99999999999999999999"}) {
    expect_error(vertices + "3 0 1 " + index, SOBB_ERROR_INDEX,
                 "line 6: there is no vertex " + std::string(index));
  }
  expect_error("OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n", SOBB_ERROR_NOT_FINITE, "line 3:");
  expect_error("OFF\n3 1 0\n0 0 1e30\n1 0 0\n0 1 0\n3 0 1 2\n", SOBB_ERROR_TOO_LARGE, "line 3:");
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
