// SPDX-License-Identifier: Apache-2.0
// SceneWriter: what it checks for every reader.
#include "scene/model/scene_writer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "scene/model/utf8.h"

namespace sobb {
namespace {

template <class Body>
sobb_status status_of(const Body& body) {
  try {
    body();
    return SOBB_OK;
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find("file"), 0U) << error.what();
    return error.status;
  }
}

const uint64_t kCorners[] = {0, 1, 2, 3};

TEST(SceneWriter, SplitsPolygonsIntoFansByMesh) {
  Scene scene;
  SceneWriter writer("file", 0, scene);
  for (const float y : {0.0F, 1.0F}) {
    writer.add_vertex(y, y, 0, "here");
    writer.add_vertex(1 - y, y, 0, "here");
  }
  writer.add_polygon(std::span(kCorners, 3), "here");
  writer.begin_mesh("empty");
  writer.begin_mesh("second");
  writer.add_polygon(kCorners, "here");
  writer.begin_mesh("last, empty");
  writer.finish();
  EXPECT_EQ(scene.indices, (std::vector<uint32_t>{0, 1, 2, 0, 1, 2, 0, 2, 3}));
  ASSERT_EQ(scene.meshes.size(), 2U);
  EXPECT_EQ(scene.meshes[0].name, "");
  EXPECT_EQ(scene.meshes[0].triangle_count, 1U);
  EXPECT_EQ(scene.meshes[1].name, "second");
  EXPECT_EQ(scene.meshes[1].first_triangle, 1U);
  EXPECT_EQ(scene.meshes[1].triangle_count, 2U);
}

TEST(SceneWriter, RefusesWhatNoSceneMayHave) {
  Scene scene;
  SceneWriter writer("file", 0, scene);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  const float beyond = std::nextafter(0x1p60F, infinite);
  const auto vertex = [&](float x) {
    return status_of([&] { writer.add_vertex(0, x, 0, "here"); });
  };
  const auto face = [&](std::vector<uint64_t> corners) {
    return status_of([&] { writer.add_polygon(corners, "here"); });
  };
  EXPECT_EQ(vertex(0x1p60F), SOBB_OK);
  EXPECT_EQ(face({0, 0, 1}), SOBB_ERROR_INDEX);
  EXPECT_EQ(vertex(nan), SOBB_OK);
  EXPECT_EQ(vertex(-infinite), SOBB_OK);
  EXPECT_EQ(vertex(-beyond), SOBB_OK);
  EXPECT_EQ(face({0, 1, 0}), SOBB_ERROR_NOT_FINITE);
  EXPECT_EQ(face({0, 0, 2}), SOBB_ERROR_NOT_FINITE);
  EXPECT_EQ(face({3, 0, 0, 0, 0}), SOBB_ERROR_TOO_LARGE);
  EXPECT_EQ(face({0, 4, 1}), SOBB_ERROR_INDEX);
  EXPECT_TRUE(scene.indices.empty());
  EXPECT_EQ(status_of([&] { writer.expect(uint64_t(1) << 33, 0); }), SOBB_ERROR_TOO_LARGE);
  EXPECT_EQ(status_of([&] { writer.expect(0, ~uint64_t(0)); }), SOBB_ERROR_TOO_LARGE);
  EXPECT_EQ(status_of([&] { writer.finish(); }), SOBB_ERROR_EMPTY);
}

TEST(SceneWriter, MeasuresTheVerticesThatTrianglesUse) {
  Scene scene;
  SceneWriter writer("file", 0, scene);
  for (const float x : {0.0F, 1.0F, 3.0F, 100.0F}) writer.add_vertex(x, x * x, -x, "here");
  writer.add_polygon(std::span(kCorners, 3), "here");
  const uint64_t twice[] = {1, 1, 2};
  writer.add_polygon(twice, "here");
  writer.finish();
  EXPECT_EQ(scene.bounds_min, (std::array<float, 3>{0, 0, -3}));
  EXPECT_EQ(scene.bounds_max, (std::array<float, 3>{3, 9, 0}));
  EXPECT_EQ(scene.degenerate_count, 1U);
}

TEST(SceneWriter, NotesWhatItPassesOver) {
  Scene scene;
  SceneWriter writer("file", 0, scene);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float x : {0.0F, 1.0F, nan, 2.0F, 1e30F}) writer.add_vertex(x, x * x, 0, "there");
  for (const size_t corners : {0U, 1U, 2U}) {
    writer.add_polygon(std::span(kCorners, corners), [&] { return std::to_string(corners); });
  }
  const uint64_t triangle[] = {0, 1, 3};
  writer.add_polygon(triangle, "here");
  writer.finish();
  ASSERT_EQ(scene.notes.size(), 2U);
  EXPECT_EQ(scene.notes[0].cause, SOBB_NOTE_SHORT_FACE);
  EXPECT_EQ(scene.notes[0].count, 3U);
  EXPECT_EQ(scene.notes[0].first, "0: a face of 0 corners");
  EXPECT_EQ(scene.notes[1].cause, SOBB_NOTE_UNUSED_VERTEX);
  EXPECT_EQ(scene.notes[1].count, 2U);
  EXPECT_EQ(scene.notes[1].first, "there: vertex (nan, nan, 0) is not finite");
  // Nobody who reads the scene meets them.
  EXPECT_EQ(scene.vertices, (std::vector<float>{0, 0, 0, 1, 1, 0, 0, 0, 0, 2, 4, 0, 0, 0, 0}));
  EXPECT_EQ(scene.bounds_max, (std::array<float, 3>{2, 4, 0}));
}

TEST(SceneWriter, KeepsTheMemoryLimitWhileItGrows) {
  Scene scene;
  SceneWriter writer("file", 1 << 20, scene);
  const auto fill = [&] {
    for (int i = 0; i < 1'000'000; ++i) writer.add_vertex(0, 0, 0, "here");
  };
  EXPECT_EQ(status_of(fill), SOBB_ERROR_MEMORY_LIMIT);
  EXPECT_LE(scene.vertices.capacity() * sizeof(float), size_t(1) << 20);
  EXPECT_EQ(status_of([&] { writer.hold(1 << 20); }), SOBB_ERROR_MEMORY_LIMIT);
}

TEST(SceneWriter, KeepsNamesInUtf8) {
  EXPECT_EQ(valid_utf8("caf\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x90\x91"),
            "caf\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x90\x91");
  EXPECT_EQ(valid_utf8("caf\xE9"), "caf?");
  EXPECT_EQ(valid_utf8("\xC0\x80 \xED\xA0\x80 \xF5 \xE2\x82"), "?? ??? ? ??");
}

}  // namespace
}  // namespace sobb
