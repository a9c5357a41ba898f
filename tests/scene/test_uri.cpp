// SPDX-License-Identifier: Apache-2.0
// The URIs of buffers: data and files, in the spellings that writers have.
#include "scene/gltf/buffers/uri.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "format/temporary_folder.h"
#include "scene/gltf_testing.h"
#include "scene/load.h"

namespace sobb {
namespace {

using namespace gltf_testing;
using reader_testing::read_scene;
using test::TemporaryFolder;

std::string base64(const std::string& bytes, const char* alphabet_end = "+/") {
  const std::string alphabet =
      std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789") + alphabet_end;
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? uint8_t(bytes[i + k]) : 0U);
    }
    for (size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : alphabet[bits >> (18 - 6 * k) & 63];
    }
  }
  return text;
}

std::string escaped(const std::string& bytes, const char* format = "%%%02X") {
  std::string text;
  for (const char c : bytes) {
    char code[4];
    std::snprintf(code, sizeof code, format, unsigned(uint8_t(c)));
    text += code;
  }
  return text;
}

// A square whose buffer has the digits 62 and 63 of Base64.
GltfFile square_with_all_digits() {
  GltfFile file = square();
  file.add_view("\xFB\xEF\xBE\xFF\xFF\xFF");
  return file;
}

void expect_read(const std::string& uri) {
  SCOPED_TRACE(uri);
  expect_square(read_scene(read_gltf, square_with_all_digits().gltf(uri)));
}

TEST(Uri, ReadsDataInEverySpelling) {
  const std::string bytes = square_with_all_digits().binary;
  const std::string text = base64(bytes);
  ASSERT_NE(text.find('+'), std::string::npos);
  ASSERT_NE(text.find('/'), std::string::npos);
  for (const char* type :
       {"data:;base64,", "data:application/octet-stream;base64,", "DATA:;BASE64,",
        "Data:Application/GLTF-Buffer;Base64,", "data:text/plain;charset=utf-8;base64,",
        "data:application/octet-stream;name=\"a b\";base64,", "data:base;base64 ,"}) {
    expect_read(type + text);
  }
  const std::string type = "data:application/octet-stream;base64,";
  expect_read(type + escaped(text));
  expect_read(type + escaped(text, "%%%02x"));
  std::string some = text;
  for (const auto& [from, to] : {std::pair("+", "%2B"), {"/", "%2f"}, {"=", "%3D"}}) {
    for (size_t at = 0; (at = some.find(from, at)) != std::string::npos; at += 3) {
      some.replace(at, 1, to);
    }
  }
  expect_read(type + some);
  expect_read(type + base64(bytes, "-_"));
  expect_read(type + text.substr(0, text.find('=')));
  std::string lines = text;
  lines.insert(40, "\r\n");
  lines.insert(20, " \n\t");
  expect_read(type + lines);
  // Without Base64 (RFC 2397) the bytes are percent-encoded.
  expect_read("data:application/octet-stream," + escaped(bytes));
  expect_read("data:," + escaped(bytes));
}

TEST(Uri, RefusesDataThatAreNone) {
  const auto refused = [](const std::string& uri, const std::string& part) {
    reader_testing::expect_error(read_gltf, square().gltf(uri), SOBB_ERROR_SCENE_REFERENCE, part);
  };
  refused("data:;base64", "its data URI is malformed");
  refused("data:;base64,A*==", "its data URI is malformed");
  refused("data:;base64,AAAAA", "its data URI is malformed");
  refused("data:;base64,AAAA", "buffer 0 has 3 bytes of the 60 declared");
  refused("data:text/plain,abc", "buffer 0 has 3 bytes of the 60 declared");
  refused("DATA:;base64,", "buffer 0 has 0 bytes of the 60 declared");
}

TEST(Uri, NotesABufferThatIsShorterThanDeclaredWhereNoTriangleNeedsTheRest) {
  GltfFile file = square();
  const std::string uri = "data:;base64," + base64(file.binary);
  file.binary += "more";
  const Scene scene = read_scene(read_gltf, file.gltf(uri));
  expect_square(scene, 1);
  expect_note(scene, SOBB_NOTE_UNUSED_ITEM, 1, "buffer 0 has 60 bytes of the 64 declared");
}

using Paths = std::vector<std::string>;

TEST(Uri, TellsThePathsThatAFileMayHave) {
  EXPECT_EQ(paths_of_uri("a.bin"), Paths{"a.bin"});
  EXPECT_EQ(paths_of_uri("../b/./a.bin"), Paths{"../b/./a.bin"});
  EXPECT_EQ(paths_of_uri("a%20b.bin"), (Paths{"a b.bin", "a%20b.bin"}));
  EXPECT_EQ(paths_of_uri("a.bin?v=2#x"), (Paths{"a.bin?v=2#x", "a.bin"}));
  EXPECT_EQ(paths_of_uri("b\\a.bin"), (Paths{"b\\a.bin", "b/a.bin"}));
  EXPECT_EQ(paths_of_uri("100%.bin"), Paths{"100%.bin"});
  EXPECT_EQ(paths_of_uri("b/a:1.bin"), Paths{"b/a:1.bin"});
  for (const char* other :
       {"http://host/x.bin", "file:///x.bin", "C:\\x.bin", "/x.bin", "%2Fx.bin"}) {
    for (const std::string& path : paths_of_uri(other)) EXPECT_EQ(path, other);
  }
  EXPECT_EQ(paths_of_uri("/etc/x.bin"), Paths());
  EXPECT_EQ(paths_of_uri("http://host/x.bin"), Paths());
}

TEST(Uri, ReadsFilesInEverySpelling) {
  const TemporaryFolder folder;
  const GltfFile file = square();
  const auto expect_found = [&](const std::string& name, const std::string& uri) {
    SCOPED_TRACE(uri);
    const std::string bin = folder.write(name, file.binary);
    expect_square(load_scene(folder.write("a.gltf", file.gltf(uri)), nullptr, 0));
    std::filesystem::remove(bin);
  };
  expect_found("a b.bin", "a b.bin");
  expect_found("a b.bin", "a%20b.bin");
  expect_found("a%20b.bin", "a%20b.bin");
  expect_found("a%20b.bin", "a%2520b.bin");
  expect_found("\xC3\xA9.bin", "%C3%A9.bin");
  expect_found("\xC3\xA9.bin", "%c3%a9.bin");
  expect_found("\xC3\xA9.bin", "\xC3\xA9.bin");
  expect_found("a.bin", "./a.bin");
  expect_found("a.bin", "a.bin?v=1");
  expect_found("a.bin", ".\\a.bin");
  expect_found("a#1.bin", "a#1.bin");
  expect_found("a:1.bin", "a%3A1.bin");
}

TEST(Uri, NamesAFileThatIsMissing) {
  const auto refused = [](const GltfFile& file, const std::string& uri, const std::string& part) {
    reader_testing::expect_error(read_gltf, file.gltf(uri), SOBB_ERROR_SCENE_REFERENCE, part);
  };
  refused(square(), "missing%20one.bin", "buffer 0: 'missing%20one.bin' cannot be read");
  refused(square(), "b\\missing.bin", "'b\\missing.bin' cannot be read");
  refused(square(), "http://host/x.bin", "is not a relative path");
  refused(square(), "/etc/x.bin", "is not a relative path");
  refused(square(), "", "buffer 0: the binary chunk is missing");
  GltfFile second = square();
  second.document["bufferViews"][0]["buffer"] = 1;
  second.document["buffers"] = {{{"byteLength", 60}}, {{"byteLength", 60}}};
  refused(second, "data:,", "buffer 1: its URI is missing");
}

}  // namespace
}  // namespace sobb
