// SPDX-License-Identifier: Apache-2.0
// The PLY reader: encodings, types, elements in any order, every error, hostile bytes.
#include "scene/text/ply.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <initializer_list>
#include <limits>

#include "scene/reader_testing.h"

namespace sobb {
namespace {

using reader_testing::Indices;
using reader_testing::Notes;
using reader_testing::notes_of;

Scene read(const std::string& text) { return reader_testing::read_scene(read_ply, text); }

void expect_error(const std::string& text, sobb_status status, const std::string& part) {
  reader_testing::expect_error(read_ply, text, status, part);
}

const char kVertexHeader[] =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const char kFaceHeader[] = "element face 2\nproperty list uchar int vertex_indices\n";
const char kVertices[] = "0 0 0\n1 0 0\n1 1 0\n0 1 .5\n";
const std::vector<float> kPositions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0.5F};

std::string header(const std::string& encoding, const std::string& elements) {
  return "ply\nformat " + encoding + " 1.0\ncomment by hand\nobj_info none\n" + elements +
         "end_header\n";
}

std::string ascii(const std::string& elements, const std::string& data) {
  return header("ascii", elements) + data;
}

// A file with the four vertices, and two faces as given.
std::string ascii_faces(const std::string& faces) {
  return ascii(std::string(kVertexHeader) + kFaceHeader, kVertices + faces);
}

// Makes the bytes of numbers, in the encoding's order of bytes.
class Bytes {
 public:
  explicit Bytes(std::string encoding)
      : encoding_(std::move(encoding)),
        swap_((encoding_ == "binary_big_endian") != (std::endian::native == std::endian::big)) {}

  template <class T>
  Bytes& add(std::initializer_list<T> values) {
    for (const T value : values) {
      const char* first = reinterpret_cast<const char*>(&value);
      std::string bytes(first, first + sizeof value);
      if (swap_) bytes = std::string(bytes.rbegin(), bytes.rend());
      data_ += bytes;
    }
    return *this;
  }
  template <class T>
  Bytes& add(const std::vector<float>& values) {
    for (const float value : values) add<T>({static_cast<T>(value)});
    return *this;
  }

  std::string file(const std::string& elements) const {
    return header(encoding_, elements) + data_;
  }

 private:
  std::string encoding_;
  bool swap_;
  std::string data_;
};

const char* const kBinaryEncodings[] = {"binary_little_endian", "binary_big_endian"};

std::string binary_square(const char* encoding) {
  Bytes bytes(encoding);
  bytes.add<float>(kPositions);
  bytes.add<uint8_t>({3}).add<int32_t>({0, 1, 2}).add<uint8_t>({4}).add<int32_t>({3, 2, 1, 0});
  return bytes.file(std::string(kVertexHeader) + kFaceHeader);
}

TEST(Ply, ReadsAscii) {
  const Scene scene = read(ascii_faces("3 0 1 2\n4 3 2 1 0\n"));
  EXPECT_EQ(scene.vertices, kPositions);
  EXPECT_EQ(scene.indices, (Indices{0, 1, 2, 3, 2, 1, 3, 1, 0}));
}

TEST(Ply, TakesEveryLineEndInAscii) {
  for (const char* line_end : {"\r\n", "\r"}) {
    std::string text;
    for (const char c : ascii_faces("\n3 0 1 2 \n\n 3 0 2 3")) {
      text += c == '\n' ? line_end : std::string(1, c);
    }
    EXPECT_EQ(read(text).indices, (Indices{0, 1, 2, 0, 2, 3}));
  }
}

TEST(Ply, ReadsBinary) {
  for (const char* encoding : kBinaryEncodings) {
    const std::string bytes = binary_square(encoding);
    for (const char* end : {"", "\n", "\r\n"}) {
      const Scene scene = read(bytes + end);
      EXPECT_EQ(scene.vertices, kPositions);
      EXPECT_EQ(scene.indices, (Indices{0, 1, 2, 3, 2, 1, 3, 1, 0}));
    }
  }
}

TEST(Ply, BinaryDataMayBeginWithALinesEnd) {
  // A header whose lines end with CR LF, then data whose first bytes are line ends too.
  Bytes bytes("binary_little_endian");
  bytes.add<uint8_t>({3}).add<uint16_t>({0, 1, 2}).add<int16_t>({0x0A0D, 0, 0, 1, 0, 0, 0, 1, 0});
  const std::string file = bytes.file(
      "element face 1\nproperty list uchar ushort vertex_index\n"
      "element vertex 3\nproperty short x\nproperty short y\nproperty short z\n");
  std::string with_crlf;
  const size_t data = file.find("end_header\n") + 11;
  for (size_t i = 0; i < file.size(); ++i) {
    if (i < data && file[i] == '\n') with_crlf += '\r';
    with_crlf += file[i];
  }
  for (const std::string& text : {file, with_crlf}) {
    const Scene scene = read(text);
    EXPECT_EQ(scene.vertices, (std::vector<float>{0x0A0D, 0, 0, 1, 0, 0, 0, 1, 0}));
    EXPECT_EQ(scene.indices, (Indices{0, 1, 2}));
  }
}

template <class T>
void check_vertex_type(const char* encoding, const std::string& type) {
  SCOPED_TRACE(type);
  Bytes bytes(encoding);
  bytes.add<T>({0, 0, 0, 100, 0, 0, 0, 1, 0});
  bytes.add<uint8_t>({3, 0, 1, 2});
  const Scene scene = read(bytes.file("element vertex 3\nproperty " + type + " x\nproperty " +
                                      type + " y\nproperty " + type +
                                      " z\nelement face 1\nproperty list uint8 uint8 "
                                      "vertex_index\n"));
  EXPECT_EQ(scene.vertices, (std::vector<float>{0, 0, 0, 100, 0, 0, 0, 1, 0}));
}

TEST(Ply, VerticesMayBeOfEveryType) {
  for (const char* encoding : kBinaryEncodings) {
    check_vertex_type<int8_t>(encoding, "char");
    check_vertex_type<uint8_t>(encoding, "uint8");
    check_vertex_type<int16_t>(encoding, "int16");
    check_vertex_type<uint16_t>(encoding, "ushort");
    check_vertex_type<int32_t>(encoding, "int32");
    check_vertex_type<uint32_t>(encoding, "uint");
    check_vertex_type<float>(encoding, "float32");
    check_vertex_type<double>(encoding, "double");
  }
}

template <class Count, class Index>
void check_list_types(const char* encoding, const std::string& count, const std::string& index) {
  SCOPED_TRACE(count + " " + index);
  Bytes bytes(encoding);
  bytes.add<float>(kPositions);
  bytes.add<Count>({3});
  bytes.add<Index>({0, 1, 2});
  bytes.add<Count>({3});
  bytes.add<Index>({3, 2, 0});
  const Scene scene =
      read(bytes.file(std::string(kVertexHeader) + "element face 2\nproperty list " + count + " " +
                      index + " vertex_index\n"));
  EXPECT_EQ(scene.indices, (Indices{0, 1, 2, 3, 2, 0}));
}

TEST(Ply, ListsMayBeOfEveryIntegerType) {
  for (const char* encoding : kBinaryEncodings) {
    check_list_types<int8_t, uint32_t>(encoding, "char", "uint");
    check_list_types<uint8_t, int32_t>(encoding, "uchar", "int");
    check_list_types<int16_t, uint16_t>(encoding, "short", "ushort");
    check_list_types<uint16_t, int16_t>(encoding, "uint16", "int16");
    check_list_types<int32_t, uint8_t>(encoding, "int32", "uint8");
    check_list_types<uint32_t, int8_t>(encoding, "uint32", "int8");
  }
}

// Faces come first; elements and properties that no scene needs come before, between and after.
const char kMixedHeader[] =
    "element nothing 1000000000000\n"
    "element camera 1\nproperty float view\nproperty list uchar short path\n"
    "element face 2\nproperty uchar red\nproperty list ushort uint vertex_indices\n"
    "property list uchar float texcoord\n"
    "element edge 1\nproperty int from\nproperty int to\n"
    "element vertex 3\nproperty double nx\nproperty list uchar uchar weights\nproperty float z\n"
    "property float y\nproperty float x\nproperty uchar red\n"
    "element tristrips 0\nproperty list int int vertex_indices\n";

TEST(Ply, PassesOverWhatItDoesNotKnowInAscii) {
  const Scene scene = read(ascii(kMixedHeader,
                                 "1.5 2 7 8\n255 3 0 1 2 6 0 0 1 0 1 1\n0 4 2 1 0 0 0\n0 1\n"
                                 "x 0 3 2 1 9\n0 2 8 8 6 5 4 9\n0 1 8 9 8 7 9\n"));
  EXPECT_EQ(scene.vertices, (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(scene.indices, (Indices{0, 1, 2, 2, 1, 0, 2, 0, 0}));
}

std::string mixed_binary(const char* encoding) {
  Bytes bytes(encoding);
  bytes.add<float>({1.5F}).add<uint8_t>({2}).add<int16_t>({7, 8});
  bytes.add<uint8_t>({255}).add<uint16_t>({3}).add<uint32_t>({0, 1, 2});
  bytes.add<uint8_t>({6}).add<float>({0, 0, 1, 0, 1, 1});
  bytes.add<uint8_t>({0}).add<uint16_t>({4}).add<uint32_t>({2, 1, 0, 0}).add<uint8_t>({0});
  bytes.add<int32_t>({0, 1});
  for (const float v : {0.0F, 3.0F, 6.0F}) {
    bytes.add<double>({0}).add<uint8_t>({2, 8, 8}).add<float>({v + 3, v + 2, v + 1});
    bytes.add<uint8_t>({9});
  }
  return bytes.file(kMixedHeader);
}

TEST(Ply, PassesOverWhatItDoesNotKnowInBinary) {
  for (const char* encoding : kBinaryEncodings) {
    const Scene scene = read(mixed_binary(encoding));
    EXPECT_EQ(scene.vertices, (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
    EXPECT_EQ(scene.indices, (Indices{0, 1, 2, 2, 1, 0, 2, 0, 0}));
  }
}

TEST(Ply, KeepsDegenerateFaces) {
  const Scene scene = read(ascii_faces("3 1 1 1\n3 0 1 0\n"));
  EXPECT_EQ(scene.indices, (Indices{1, 1, 1, 0, 1, 0}));
  EXPECT_EQ(scene.degenerate_count, 2U);
}

const char kStripHeader[] = "element tristrips 1\nproperty list int int vertex_indices\n";

TEST(Ply, ReadsTriangleStrips) {
  const auto strips = [](const std::string& list) {
    return read(ascii(std::string(kVertexHeader) + kStripHeader, kVertices + list));
  };
  EXPECT_EQ(strips("8 0 1 3 2 -1 0 1 2\n").indices, (Indices{0, 1, 3, 3, 1, 2, 0, 1, 2}));
  EXPECT_EQ(strips("4 0 1 2 3").indices, (Indices{0, 1, 2, 2, 1, 3}));
  EXPECT_EQ(strips("7 0 1 2 -1 -1 -1 -1").indices, (Indices{0, 1, 2}));
  // Strips turn by their repeated corners, which make degenerate triangles.
  EXPECT_EQ(strips("5 0 1 2 2 3").degenerate_count, 2U);
  EXPECT_EQ(notes_of(strips("9 0 1 2 -1 3 -1 3 3 -1")),
            (Notes{"1, 2, line 16: a face of 1 corner"}));
  expect_error(
      ascii(std::string(kVertexHeader) + kStripHeader, std::string(kVertices) + "3 0 1 -2"),
      SOBB_ERROR_INDEX, "line 16: there is no vertex -2");
}

TEST(Ply, ReadsTriangleStripsInBinary) {
  for (const char* encoding : kBinaryEncodings) {
    for (const char* type : {"int", "uint"}) {  // whose -1 has the same bits
      Bytes bytes(encoding);
      bytes.add<float>(kPositions).add<int32_t>({8, 0, 1, 3, 2, -1, 0, 1, 2});
      bytes.add<uint8_t>({3}).add<int32_t>({3, 2, 1}).add<uint8_t>({0});
      const Scene scene =
          read(bytes.file(std::string(kVertexHeader) + "element tristrips 1\nproperty list int " +
                          type + " vertex_index\n" + kFaceHeader));
      EXPECT_EQ(scene.indices, (Indices{0, 1, 3, 3, 1, 2, 0, 1, 2, 3, 2, 1}));
      EXPECT_EQ(notes_of(scene), (Notes{"1, 1, face 1: a face of 0 corners"}));
    }
    Bytes short_list(encoding);
    short_list.add<int32_t>({5}).add<int16_t>({0, 1, 2, -1, 0}).add<float>(kPositions);
    const Scene early =
        read(short_list.file("element tristrips 1\nproperty list int short vertex_indices\n" +
                             std::string(kVertexHeader)));
    EXPECT_EQ(early.indices, (Indices{0, 1, 2}));
  }
}

TEST(Ply, PassesOverSurplusValuesAndBytes) {
  const Scene scene = read(ascii_faces("3 0 1 2 0 0\n3 0 2 3 x\nmore than\n\ndeclared\n"));
  EXPECT_EQ(scene.indices, (Indices{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(notes_of(scene), (Notes{"3, 6, line 16: \"0\" is more than the file declares"}));
  for (const char* encoding : kBinaryEncodings) {
    const Scene binary = read(binary_square(encoding) + "\n12345");
    EXPECT_EQ(binary.indices, (Indices{0, 1, 2, 3, 2, 1, 3, 1, 0}));
    EXPECT_EQ(notes_of(binary), (Notes{"3, 6, 6 bytes more than the header declares"}));
  }
}

TEST(Ply, PassesOverShortFacesAndUnusableVertices) {
  const std::string vertices = "0 0 0\n1 0 0\nnan nan nan\n0 1 0\n";
  const std::string start = std::string(kVertexHeader) + kFaceHeader;
  const Scene scene = read(ascii(start, vertices + "3 0 1 3\n2 0 2\n"));
  EXPECT_EQ(scene.indices, (Indices{0, 1, 3}));
  EXPECT_EQ(notes_of(scene), (Notes{"1, 1, line 17: a face of 2 corners",
                                    "2, 1, line 14: vertex (nan, nan, nan) is not finite"}));
  expect_error(ascii(start, vertices + "3 0 1 3\n3 0 2 1\n"), SOBB_ERROR_NOT_FINITE,
               "line 17: corner 1: vertex (nan, nan, nan) is not finite");
}

// Where the header's lines end with CR, an LF after it is data.
TEST(Ply, BinaryDataMayBeginWithAnLfAfterCr) {
  Bytes bytes("binary_little_endian");
  bytes.add<uint8_t>({10, 0, 0, 1, 0, 0, 1, 1, 0}).add<uint8_t>({3, 0, 1, 2});
  std::string file = bytes.file(
      "element vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n"
      "element face 1\nproperty list uchar uchar vertex_index\n");
  const size_t data = file.find("end_header\n") + 11;
  std::replace(file.begin(), file.begin() + std::ptrdiff_t(data), '\n', '\r');
  EXPECT_EQ(read(file).vertices, (std::vector<float>{10, 0, 0, 1, 0, 0, 1, 1, 0}));
}

TEST(Ply, TakesBlankLinesAndCapitalsInItsHeader) {
  std::string text = ascii_faces("3 0 1 2\n3 0 2 3\n");
  text.replace(0, 4, "PLY\n\n");
  EXPECT_EQ(read(text).indices, (Indices{0, 1, 2, 0, 2, 3}));
}

TEST(Ply, PassesOverHeaderLinesWithoutAKeyword) {
  std::string text = ascii_faces("3 0 1 2\n3 0 2 3\n");
  text.insert(text.find("element face"), "Created by hand, for a test\n");
  const Scene scene = read(text);
  EXPECT_EQ(scene.indices, (Indices{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(notes_of(scene), (Notes{"4, 1, line 9: \"Created\" is no statement of a header"}));
}

TEST(Ply, SplitsConcavePolygonsByTheirArea) {
  const Scene scene =
      read(ascii("element vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
                 "element face 1\nproperty list uchar int vertex_indices\n",
                 "0 4 0\n0 4 1\n0 1 1\n0 1 7\n0 0 7\n0 0 0\n6 0 1 2 3 4 5\n"));
  EXPECT_EQ(scene.indices.size(), 12U);
  EXPECT_EQ(reader_testing::double_area(scene), 20);
}

TEST(Ply, RefusesOtherFormsByName) {
  const auto unsupported = SOBB_ERROR_SCENE_UNSUPPORTED;
  expect_error("ply\nformat ascii 1.1\nend_header\n", unsupported, "line 2: version \"1.1\"");
}

TEST(Ply, NamesTheLineOfAHeadersError) {
  const auto syntax = SOBB_ERROR_SCENE_SYNTAX;
  const std::string start = "ply\nformat ascii 1.0\n";
  const std::string end = "end_header\n";
  expect_error("", syntax, "the first line is not \"ply\"");
  expect_error("plyx\n", syntax, "line 1: the first line is not \"ply\"");
  expect_error("ply\n", syntax, "the file ends before end_header");
  expect_error("ply\nend_header\n", syntax, "line 2: \"end_header\" cannot stand here");
  expect_error("ply\nformat text 1.0\n", syntax, "line 2: \"text\" is no format");
  expect_error(start + "format ascii 1.0\n", syntax, "line 3: \"format\" cannot");
  expect_error(start + "property int x\n", syntax, "line 3: \"property\" cannot");
  expect_error(start + "what 1\n", syntax, "the file ends before end_header");
  expect_error("ply\nelement face 1\nend_header\n", syntax, "line 3: \"end_header\" cannot");
  expect_error(start + "element\n", syntax, "line 3: the line ends where an element's name");
  expect_error(start + "element face\n", syntax, "line 3: the line ends where the count");
  expect_error(start + "element face -1\n", syntax, "line 3: \"-1\"");
  expect_error(start + "element face 99999999999999999999\n", syntax, "line 3:");
  expect_error(start + "element face 1 2\n", syntax, "line 3: \"2\" where the line's end");
  expect_error(start + "element face 1\nproperty list int\n", syntax, "line 4: \"\" is no type");
  expect_error(start + "element face 1\nproperty int128 x\n", syntax, "line 4: \"int128\"");
  expect_error(start + "element face 1\nproperty int\n", syntax, "line 4: the line ends");
  expect_error(start + "element face 1\nproperty list float int x\n", syntax, "line 4: a list's");
  const std::string vertex = "element vertex 0\nproperty int x\nproperty int y\n";
  expect_error(start + vertex + end, syntax, "element vertex has property z not at all");
  expect_error(start + vertex + "property int x\nproperty int z\n" + end, syntax,
               "element vertex has property x more than once");
  expect_error(start + vertex + "property list int int z\n" + end, syntax,
               "property z of vertex is a list");
  expect_error(start + vertex + "property int z\nelement vertex 0\n" + end, syntax,
               "the header has element vertex twice");
  expect_error(start + "element face 0\nproperty int a\n" + end, syntax,
               "element face has property vertex_indices not at all");
  expect_error(start + "element face 0\nproperty int vertex_index\n" + end, syntax,
               "property vertex_index of face is no list of integers");
  expect_error(start + "element face 0\nproperty list int float vertex_index\n" + end, syntax,
               "property vertex_index of face is no list of integers");
}

TEST(Ply, NamesTheLineOfADatasError) {
  const auto syntax = SOBB_ERROR_SCENE_SYNTAX;
  // The header has eleven lines, the vertices are on 12 to 15.
  const std::string good = ascii_faces("3 0 1 2\n3 0 2 3\n");
  const auto with = [&good](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  expect_error(with("1 0 0", "1 0"), syntax, "line 13: the line ends where z should be");
  expect_error(with("1 0 0", "1 0 zero"), syntax, "line 13: \"zero\" where z should be");
  expect_error(with("1 0 0", "1 0 nan"), SOBB_ERROR_NOT_FINITE, "line 16: corner 1: vertex");
  expect_error(with("1 0 0", "1 0 -1e50"), SOBB_ERROR_TOO_LARGE, "line 16: corner 1: vertex");
  expect_error(ascii_faces("3 0 1 2\n-3 0 1 2\n"), syntax, "line 17: \"-3\"");
  expect_error(ascii_faces("3 0 1 2\n3.0 0 1 2\n"), syntax, "line 17: \"3.0\"");
  expect_error(ascii_faces("3 0 1 2\n4 0 1 2\n"), syntax, "line 17: the line ends");
  expect_error(ascii_faces("3 0 1 2\n"), syntax, "line 16: the file ends before face 1 of 2");
  for (const char* index : {"4", "-1", "99999999999999999999"}) {
    expect_error(ascii_faces("3 0 1 2\n3 0 1 " + std::string(index)), SOBB_ERROR_INDEX,
                 "line 17: there is no vertex " + std::string(index));
  }
}

// Four vertices, a good face, and another of `count` corners 0, 1, `index`.
std::string binary_faces(const char* encoding, int8_t count, int32_t index) {
  Bytes bytes(encoding);
  bytes.add<float>(kPositions).add<int8_t>({3}).add<int32_t>({0, 1, 2});
  bytes.add<int8_t>({count}).add<int32_t>({0, 1, index});
  return bytes.file(std::string(kVertexHeader) +
                    "element face 2\nproperty list char int vertex_indices\n");
}

TEST(Ply, NamesTheItemOfABinaryError) {
  const auto syntax = SOBB_ERROR_SCENE_SYNTAX;
  for (const char* encoding : kBinaryEncodings) {
    const auto faces = [&](int8_t count, int32_t index) {
      return binary_faces(encoding, count, index);
    };
    EXPECT_EQ(read(faces(3, 3)).indices, (Indices{0, 1, 2, 0, 1, 3}));
    expect_error(faces(3, 4), SOBB_ERROR_INDEX, "face 1: there is no vertex 4");
    expect_error(faces(3, -1), SOBB_ERROR_INDEX, "face 1: there is no vertex -1");
    expect_error(faces(4, 2), syntax, "face 1: the file ends within it");
    expect_error(faces(-1, 2), syntax, "face 1: a list of length -1");
    const auto vertex = [&](double y) {
      return Bytes(encoding)
          .add<double>({0, y, 0})
          .add<uint8_t>({3, 0, 0, 0})
          .file(
              "element vertex 1\nproperty double x\nproperty double y\nproperty double z\n"
              "element face 1\nproperty list uchar uchar vertex_index\n");
    };
    EXPECT_EQ(read(vertex(0)).degenerate_count, 1U);
    const char place[] = "face 0: corner 0: vertex (0, ";
    expect_error(vertex(1e300), SOBB_ERROR_TOO_LARGE, place);
    expect_error(vertex(std::numeric_limits<double>::quiet_NaN()), SOBB_ERROR_NOT_FINITE, place);
    expect_error(vertex(-std::numeric_limits<double>::infinity()), SOBB_ERROR_NOT_FINITE, place);
  }
}

TEST(Ply, WithoutTrianglesIsEmpty) {
  expect_error(ascii("", ""), SOBB_ERROR_EMPTY, "no triangles");
  expect_error(ascii(kVertexHeader, kVertices), SOBB_ERROR_EMPTY, "no triangles");
  expect_error(header("binary_big_endian", ""), SOBB_ERROR_EMPTY, "no triangles");
  expect_error(ascii("element face 1\nproperty list int int vertex_index\n", "3 0 0 0\n"),
               SOBB_ERROR_INDEX, "there is no vertex 0");
}

TEST(Ply, RefusesHugeCountsAtOnce) {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  for (const char* encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const char* count : {"4000000000", "18446744073709551615"}) {
      const std::string vertices = "element vertex " + std::string(count) + "\n" + xyz;
      const std::string faces =
          "element face " + std::string(count) + "\nproperty list uchar int vertex_indices\n";
      expect_error(header(encoding, vertices) + "0 0 0\n", SOBB_ERROR_SCENE_SYNTAX, "do not fit");
      expect_error(header(encoding, faces) + "3 0 0 0\n", SOBB_ERROR_SCENE_SYNTAX, "do not fit");
    }
  }
  // A list that says it is longer than the file.
  Bytes bytes("binary_little_endian");
  bytes.add<float>(kPositions).add<uint32_t>({0xFFFFFFFF}).add<int32_t>({0, 1, 2});
  expect_error(bytes.file(std::string(kVertexHeader) +
                          "element face 1\nproperty list uint int vertex_indices\n"),
               SOBB_ERROR_SCENE_SYNTAX, "face 0: the file ends within it");
  bytes = Bytes("binary_little_endian").add<uint32_t>({0xFFFFFFFF}).add<int32_t>({0, 1, 2});
  expect_error(bytes.file("element other 1\nproperty list uint double values\n"),
               SOBB_ERROR_SCENE_SYNTAX, "other 0: the file ends within it");
}

TEST(Ply, SurvivesDamage) {
  reader_testing::check_damaged(read_ply, ascii_faces("3 0 1 2\n4 3 2 1 0\n"));
  for (const char* encoding : kBinaryEncodings) {
    reader_testing::check_damaged(read_ply, binary_square(encoding));
    reader_testing::check_damaged(read_ply, mixed_binary(encoding));
  }
}

TEST(Ply, SurvivesRandomBytes) {
  const std::string elements = std::string(kVertexHeader) + kFaceHeader;
  reader_testing::check_random(
      read_ply, "ply\nformat ascii 1.0\n",
      {"element vertex 1\n", "element face 1\n", "property float x\n", "property int y\n",
       "property int z\n", "property list int int vertex_index\n", "end_header\n", "0", "1"});
  for (const char* encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    reader_testing::check_random(read_ply, header(encoding, elements), {"0", "1", "2", "3", "-1"});
  }
}

TEST(Ply, ReadsTheBunny) {
  const std::string bytes = reader_testing::real_scene("bunny.ply");
  if (bytes.empty()) GTEST_SKIP() << "SOBB_SCENES has no bunny.ply";
  const Scene scene = read(bytes);
  EXPECT_EQ(scene.indices.size() / 3, 69451U);
  EXPECT_EQ(scene.vertices.size() / 3, 35947U);
}

}  // namespace
}  // namespace sobb
