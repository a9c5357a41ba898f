// SPDX-License-Identifier: Apache-2.0
// The container GLB, as the specification and as writers have it.
#include <gtest/gtest.h>

#include "scene/gltf_testing.h"

namespace sobb {
namespace {

using namespace gltf_testing;
using reader_testing::read_scene;

std::string word(uint32_t value) { return GltfFile::word(value); }

// A GLB with another declared length.
std::string with_length(std::string glb, size_t length) {
  return glb.replace(8, 4, word(uint32_t(length)));
}

std::string chunk(const std::string& type, const std::string& content) {
  return word(uint32_t(content.size())) + type + content;
}

TEST(Glb, PassesOverBytesBehindTheLastChunk) {
  const std::string glb = square().glb();
  for (size_t tail : {1, 3, 7, 8, 9, 100}) {
    SCOPED_TRACE(tail);
    const std::string bytes = glb + std::string(tail, '\x7F');
    for (const std::string& file : {bytes, with_length(bytes, bytes.size())}) {
      const Scene scene = read_scene(read_gltf, file);
      expect_square(scene, 1);
      expect_note(scene, SOBB_NOTE_SURPLUS, 1,
                  std::to_string(tail) + " bytes behind the last chunk, at byte " +
                      std::to_string(glb.size()));
    }
  }
  // Zeros are empty chunks as well.
  const std::string zeros = glb + std::string(16, '\0');
  expect_square(read_scene(read_gltf, with_length(zeros, zeros.size())));
}

TEST(Glb, IgnoresUnknownChunks) {
  const std::string glb = square().glb();
  const std::string more = glb + chunk("XTRA", "1234") + chunk("JSON", "{}  ") + chunk("NONE", "");
  expect_square(read_scene(read_gltf, with_length(more, more.size())));
  // A chunk before the binary one.
  GltfFile file = square();
  json complete = file.document;
  complete["buffers"][0]["byteLength"] = file.binary.size();
  std::string text = complete.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::string chunks =
      chunk("JSON", text) + chunk("XTRA", "1234") + chunk({"BIN\0", 4}, file.binary);
  expect_square(
      read_scene(read_gltf, "glTF" + word(2) + word(uint32_t(12 + chunks.size())) + chunks));
}

TEST(Glb, TakesAChunkThatLeavesTheDeclaredLengthButNotTheFile) {
  const std::string glb = square().glb();
  expect_square(read_scene(read_gltf, with_length(glb, glb.size() - 4)));
}

TEST(Glb, TakesJsonPaddedWithZeros) {
  std::string glb = square().glb();
  const size_t end = glb.find("BIN") - 4;
  const uint32_t size = uint32_t(end - 20 + 4);
  glb.insert(end, 4, '\0');
  glb.replace(12, 4, word(size));
  expect_square(read_scene(read_gltf, with_length(glb, glb.size())));
}

TEST(Glb, RefusesOtherVersionsByNumber) {
  std::string glb = square().glb();
  for (const uint32_t version : {0U, 1U, 3U}) {
    glb.replace(4, 4, word(version));
    reader_testing::expect_error(read_gltf, glb, SOBB_ERROR_SCENE_UNSUPPORTED,
                                 "glTF " + std::to_string(version) + ".0: only 2.x is read");
  }
}

TEST(Glb, RefusesWhatPromisesMoreThanTheFileHas) {
  const std::string glb = square().glb();
  const auto refused = [](const std::string& bytes, const std::string& part) {
    reader_testing::expect_error(read_gltf, bytes, SOBB_ERROR_SCENE_SYNTAX, part);
  };
  refused(glb.substr(0, 11), "shorter than the header");
  refused(glb.substr(0, glb.size() - 1), "truncated");
  refused(with_length(glb.substr(0, glb.size() - 1), glb.size() - 1), "are left");
  refused(with_length(glb.substr(0, 12), 12), "no JSON chunk");
  refused(with_length(glb, 12), "no JSON chunk");
  std::string other = glb;
  other.replace(16, 4, "JSOM");
  refused(other, "the first chunk is not of JSON");
}

}  // namespace
}  // namespace sobb
