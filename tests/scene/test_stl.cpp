// SPDX-License-Identifier: Apache-2.0
// The STL reader: both forms and how it tells them apart, every error, hostile bytes.
#include "scene/text/stl.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "scene/reader_testing.h"

namespace sobb {
namespace {

using reader_testing::Indices;
using reader_testing::Notes;
using reader_testing::notes_of;

Scene read(const std::string& text) { return reader_testing::read_scene(read_stl, text); }

void expect_error(const std::string& text, sobb_status status, const std::string& part) {
  reader_testing::expect_error(read_stl, text, status, part);
}

const char kFacet[] =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1.5 0\n"
    " endloop\nendfacet\n";

std::string solid(const std::string& facets) { return "solid part\n" + facets + "endsolid part\n"; }

// A binary STL, from nine coordinates per triangle.
std::string binary(const std::vector<float>& coordinates, const std::string& header = "") {
  std::string bytes = header;
  bytes.resize(80);
  const auto append = [&bytes](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  append(static_cast<uint32_t>(coordinates.size() / 9));
  for (size_t i = 0; i < coordinates.size(); i += 9) {
    for (int k = 0; k < 3; ++k) append(std::numeric_limits<float>::quiet_NaN());
    for (int k = 0; k < 9; ++k) append(coordinates[i + k]);
    append(static_cast<uint16_t>(0xFFFF));
  }
  return bytes;
}

const std::vector<float> kTwo = {0, 0, 0, 1, 0, 0, 0, 1.5F, 0, 2, 2, 2, 2, 2, 2, 3, 3, 3};

TEST(Stl, ReadsAscii) {
  const Scene scene = read(solid(std::string(kFacet) + kFacet));
  EXPECT_EQ(scene.indices, (Indices{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(scene.vertices,
            (std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1.5F, 0, 0, 0, 0, 1, 0, 0, 0, 1.5F, 0}));
  ASSERT_EQ(scene.meshes.size(), 1U);
  EXPECT_EQ(scene.meshes[0].name, "part");
}

TEST(Stl, ReadsSeveralSolids) {
  const Scene scene =
      read(solid(kFacet) + "solid\nendsolid\n\nsolid  b c \n" + kFacet + kFacet + "endsolid");
  ASSERT_EQ(scene.meshes.size(), 2U);
  EXPECT_EQ(scene.meshes[1].name, "b c");
  EXPECT_EQ(scene.meshes[1].first_triangle, 1U);
  EXPECT_EQ(scene.meshes[1].triangle_count, 2U);
}

TEST(Stl, TakesCapitalsAnyNormalAndLineEnds) {
  const Scene scene = read(
      "SOLID\r\n  FACET NORMAL -nan(ind) 1.#QNAN 0\r\n\r\nOUTER LOOP\r\nVERTEX 0 0 0\r\n"
      "VERTEX 1 0 0\r\nVERTEX 0 1 0\r\nENDLOOP\r\nENDFACET\r\nENDSOLID\r\n");
  EXPECT_EQ(scene.indices, (Indices{0, 1, 2}));
}

// What writers make of the statements that end something.
TEST(Stl, TakesEverySpellingOfEnds) {
  const std::string begin =
      "solid M\n facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n"
      "  vertex 1 0 0\n  vertex 0 1.5 0\n";
  for (const char* end :
       {"endloop\nendfacet\nendsolid", "end loop\nend facet\nend solid M\n", "endloop\nendfacet\n",
        "endloop\nendfacet\nendsolidM", "ENDLOOP\nENDFACET\nENDSOLIDM of wool\n", "endloop\n", "",
        "endfacet\nendsolid", "endsolid M", "endloop endfacet endsolid M"}) {
    const Scene scene = read(begin + end);
    EXPECT_EQ(scene.vertices, (std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1.5F, 0})) << end;
    EXPECT_EQ(scene.indices, (Indices{0, 1, 2})) << end;
    EXPECT_EQ(notes_of(scene), Notes{}) << end;
  }
}

TEST(Stl, SolidsNeedNoEnd) {
  const Scene scene = read("solid a\n" + std::string(kFacet) + "solid b\n" + kFacet + kFacet);
  ASSERT_EQ(scene.meshes.size(), 2U);
  EXPECT_EQ(scene.meshes[0].name, "a");
  EXPECT_EQ(scene.meshes[1].name, "b");
  EXPECT_EQ(scene.meshes[1].triangle_count, 2U);
}

TEST(Stl, TakesEveryBeginning) {
  for (const char* begin :
       {"solid\n", "\n\n  solid name\n", "SOLID\n", "Solid x\r\n", "solidname\r",
        "\xEF\xBB\xBFsolid\n", "# made by hand\nsolid\n", "\t", ""}) {
    const Scene scene = read(begin + std::string(kFacet) + "endsolid\n");
    EXPECT_EQ(scene.indices, (Indices{0, 1, 2})) << begin;
  }
  // All on one line but the name, and a normal that is missing.
  EXPECT_EQ(read("solid x\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 "
                 "endloop endfacet facet outerloop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop "
                 "endfacet endsolid")
                .indices.size(),
            6U);
}

TEST(Stl, FacetsOfOtherThanThreeVertices) {
  const auto facet = [](const std::string& vertices) {
    return "facet normal 0 0 1\nouter loop\n" + vertices + "endloop\nendfacet\n";
  };
  const std::string three = "vertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n";
  const Scene scene = read(
      solid(facet(three + "vertex 0 1 0\n") + facet("vertex 0 0 0\n") + facet("") + facet(three)));
  EXPECT_EQ(scene.indices, (Indices{0, 1, 2, 0, 2, 3, 5, 6, 7}));
  EXPECT_EQ(notes_of(scene), (Notes{"1, 2, line 13: a face of 1 corner"}));
  EXPECT_EQ(notes_of(read(solid(facet("vertex 0 0 0 9 8\nvertex 1 0 0\nvertex 0 1 0\n")))),
            (Notes{"3, 2, line 4: \"9\" is more than the file declares"}));
}

TEST(Stl, PassesOverBytesAfterTheLastTriangle) {
  for (const char* header : {"", "solid that is binary"}) {
    const std::string bytes = binary(kTwo, header);
    const Scene scene = read(bytes + "xyz");
    EXPECT_EQ(scene.vertices, kTwo);
    EXPECT_EQ(notes_of(scene), (Notes{"3, 3, 3 bytes after triangle 2"}));
    EXPECT_EQ(read(bytes + binary(kTwo)).vertices, kTwo);
  }
}

TEST(Stl, TakesTheCountFromTheSizeWhereItIsZero) {
  std::string bytes = binary(kTwo);
  bytes.replace(80, 4, std::string(4, '\0'));
  EXPECT_EQ(read(bytes).vertices, kTwo);
  expect_error(bytes + "x", SOBB_ERROR_EMPTY, "passed over 101 ");
}

TEST(Stl, RefusesWideCharactersByName) {
  std::string wide = "\xFF\xFE";
  for (const char c : solid(kFacet)) wide += {c, '\0'};
  expect_error(wide, SOBB_ERROR_SCENE_UNSUPPORTED, "text in UTF-16");
  expect_error(wide.substr(2), SOBB_ERROR_SCENE_UNSUPPORTED, "text in UTF-16");
}

TEST(Stl, ReadsBinary) {
  for (const char* header : {"", "solid that is binary", "solid\nfacet normal 0 0 1\n"}) {
    const Scene scene = read(binary(kTwo, header));
    EXPECT_EQ(scene.vertices, kTwo);
    EXPECT_EQ(scene.indices, (Indices{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(scene.degenerate_count, 1U);
  }
}

TEST(Stl, NamesTheLineOfASyntaxError) {
  const auto syntax = SOBB_ERROR_SCENE_SYNTAX;
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = solid(kFacet);
    return text.replace(text.find(from), from.size(), to);
  };
  expect_error(with("facet", "face"), syntax,
               "line 2: \"face\" where a statement of STL should be");
  expect_error(with("endloop", "endlop"), syntax, "line 7: \"lop\" where a statement");
  expect_error(with("endloop", "end"), syntax, "line 7: \"\" where a statement");
  expect_error(with("1 0 0", "1 0"), syntax, "line 5: the line ends where z");
  expect_error(with("1 0 0", "1 y 0"), syntax, "line 5: \"y\" where y should be");
  expect_error(with("1 0 0", "1 0,5 0"), syntax, "line 5: \"0,5\" where y should be");
  expect_error(solid(kFacet) + "vertex 0 0 0", syntax, "line 10: \"vertex\" where a statement");
  expect_error(solid(kFacet) + "facet", syntax, "line 10: the file ends within a facet");
  expect_error("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0", syntax,
               "line 5: the file ends within a facet");
}

TEST(Stl, NamesThePlaceOfACoordinateOutOfRange) {
  const std::string rest = "\nvertex 1 0 0\nvertex 0 1 0\nendloop\n";
  expect_error("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 inf" + rest,
               SOBB_ERROR_NOT_FINITE, "line 7: corner 0: vertex (0, 0, inf)");
  expect_error("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1e39" + rest,
               SOBB_ERROR_TOO_LARGE, "line 7: corner 0: vertex (0, 0, ");
  std::vector<float> coordinates = kTwo;
  coordinates[13] = std::numeric_limits<float>::quiet_NaN();
  expect_error(binary(coordinates), SOBB_ERROR_NOT_FINITE, "triangle 1:");
  coordinates[13] = 1e30F;
  expect_error(binary(coordinates), SOBB_ERROR_TOO_LARGE, "triangle 1:");
}

TEST(Stl, WithoutTrianglesIsEmpty) {
  expect_error("solid\nendsolid\n", SOBB_ERROR_EMPTY, "no triangles");
  expect_error(binary({}), SOBB_ERROR_EMPTY, "no triangles");
}

TEST(Stl, RefusesAWrongSizeAtOnce) {
  const auto syntax = SOBB_ERROR_SCENE_SYNTAX;
  std::string bytes = binary(kTwo);
  expect_error(bytes.substr(0, 183), syntax, "the file has 183");
  bytes.replace(80, 4, "\xFF\xFF\xFF\xFF");
  expect_error(bytes, syntax, "4294967295 triangles takes 214748364834 bytes");
  // Text has no zero byte: this is binary, cut short.
  expect_error(binary(kTwo, "solid").substr(0, 183), syntax, "the file has 183");
  expect_error("", syntax, "no STL");
  expect_error("ply", syntax, "no STL");
}

TEST(Stl, SurvivesDamage) {
  reader_testing::check_damaged(read_stl, solid(kFacet));
  reader_testing::check_damaged(read_stl, binary(kTwo));
  reader_testing::check_damaged(read_stl, binary(kTwo, "solid"));
}

TEST(Stl, SurvivesRandomBytes) {
  reader_testing::check_random(read_stl, "", {"solid", "facet"});
  reader_testing::check_random(
      read_stl, "solid\n",
      {"\nfacet", "\nouter loop", "\nvertex 0 0 0", "\nendloop", "\nendfacet", "1", "\nendsolid"});
}

TEST(Stl, ReadsTheShipHull) {
  const std::string bytes = reader_testing::real_scene("DTC-scaled.stl");
  if (bytes.empty()) GTEST_SKIP() << "SOBB_SCENES has no DTC-scaled.stl";
  EXPECT_EQ(read(bytes).indices.size() / 3, 116062U);
}

}  // namespace
}  // namespace sobb
