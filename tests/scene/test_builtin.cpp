// SPDX-License-Identifier: Apache-2.0
// Built-in scenes: the same bits everywhere, sizes, turns, names.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/builtin/builtin.h"
#include "scene/error_testing.h"
#include "scene/load.h"

namespace sobb {
namespace {

const char* const kNames[] = {"hairball", "wool", "pipes", "foliage", "city", "terrain"};

Scene load(const std::string& source) { return load_scene(source, nullptr, 0); }

// The FNV-1a hash of the vertices' and indices' bytes.
uint64_t hash(const Scene& scene) {
  uint64_t h = 0xCBF29CE484222325;
  const auto add = [&h](const void* data, size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (size_t i = 0; i < size; ++i) h = (h ^ bytes[i]) * 0x100000001B3;
  };
  add(scene.vertices.data(), scene.vertices.size() * sizeof(float));
  add(scene.indices.data(), scene.indices.size() * sizeof(uint32_t));
  return h;
}

// Published figures rest on these bits: a scene changes only with a new minor version.
TEST(Builtin, GivesTheSameBitsEverywhere) {
  const std::pair<const char*, uint64_t> pinned[] = {
      {"builtin:hairball:20000", 0x3084EBC8916F9BF5},
      {"builtin:wool:20000", 0xD4D4C8FC05746E79},
      {"builtin:pipes:20000", 0xCB0691DC60845C8D},
      {"builtin:foliage:20000", 0xA61C94294E7149E9},
      {"builtin:city:20000", 0x0E9E9D3279069867},
      {"builtin:terrain:20000", 0xAF41C0B35B65770D},
      {"builtin:pipes:20000@27.5", 0xED4BDEA449C0E15F},
      {"builtin:terrain:500@-90", 0xCCF303E68491D0BB}};
  for (const auto& [source, expected] : pinned) EXPECT_EQ(hash(load(source)), expected) << source;
}

TEST(Builtin, ComesNearTheTrianglesAskedForAndNeverBeyond) {
  for (const std::string name : kNames) {
    for (const uint64_t triangles : {100, 101, 150, 999, 5'000, 33'333, 250'000, 1'000'000}) {
      const Scene scene = load("builtin:" + name + ":" + std::to_string(triangles));
      const uint64_t made = scene.indices.size() / 3;
      EXPECT_LE(made, triangles) << name;
      // No part fills the rest, as after the last pipe or a terrain's last row.
      EXPECT_GE(made + 50 + triangles / 1000, triangles) << name;
      EXPECT_EQ(scene.degenerate_count, 0U) << name << triangles;
      ASSERT_EQ(scene.meshes.size(), 1U);
      EXPECT_EQ(scene.meshes[0].name, name);
    }
  }
}

TEST(Builtin, HasTheDefaultSize) {
  EXPECT_EQ(hash(load("builtin:city")), hash(load("builtin:city:250000")));
}

TEST(Builtin, TurnsVerticesAndViewsAlike) {
  for (const std::string name : kNames) {
    const Scene straight = load("builtin:" + name + ":2000");
    const Scene turned = load("builtin:" + name + ":2000@120");
    ASSERT_EQ(straight.vertices.size(), turned.vertices.size());
    EXPECT_EQ(straight.indices, turned.indices);
    ASSERT_EQ(straight.views.size(), turned.views.size());
    const auto distance = [](const float* a, const float* b) {
      return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    };
    for (size_t i = 0; i < straight.vertices.size(); i += 30) {
      EXPECT_NEAR(distance(&straight.vertices[i], straight.views[0].eye),
                  distance(&turned.vertices[i], turned.views[0].eye), 2e-5);
      EXPECT_NEAR(distance(&straight.vertices[i], straight.views[0].target),
                  distance(&turned.vertices[i], turned.views[0].target), 2e-5);
    }
    EXPECT_GT(distance(&straight.vertices[0], &turned.vertices[0]), 0.01);
  }
  EXPECT_EQ(hash(load("builtin:wool:500@0")), hash(load("builtin:wool:500")));
}

TEST(Builtin, ReadsNames) {
  const BuiltinName name = parse_builtin("builtin:pipes:12800000@-12.5");
  EXPECT_EQ(name.scene, "pipes");
  EXPECT_EQ(name.triangles, 12'800'000U);
  EXPECT_EQ(name.degrees, -12.5);
  EXPECT_EQ(parse_builtin("builtin:pipes@9").triangles, 250'000U);
}

TEST(Builtin, RefusesWrongNames) {
  const std::pair<const char*, sobb_status> wrong[] = {
      {"builtin:", SOBB_ERROR_SCENE_FORMAT},
      {"builtin:bunny", SOBB_ERROR_SCENE_FORMAT},
      {"builtin:Pipes", SOBB_ERROR_SCENE_FORMAT},
      {"builtin:pipes:", SOBB_ERROR_SCENE_SYNTAX},
      {"builtin:pipes:99", SOBB_ERROR_SCENE_SYNTAX},
      {"builtin:pipes:-1000", SOBB_ERROR_SCENE_SYNTAX},
      {"builtin:pipes:1000x", SOBB_ERROR_SCENE_SYNTAX},
      {"builtin:pipes:1000000001", SOBB_ERROR_SCENE_SYNTAX},
      {"builtin:pipes:99999999999999999999", SOBB_ERROR_SCENE_SYNTAX},
      {"builtin:pipes@", SOBB_ERROR_SCENE_SYNTAX},
      {"builtin:pipes@north", SOBB_ERROR_SCENE_SYNTAX},
      {"builtin:pipes@nan", SOBB_ERROR_SCENE_SYNTAX},
      {"builtin:pipes@361", SOBB_ERROR_SCENE_SYNTAX},
      {"builtin:pipes@5:1000", SOBB_ERROR_SCENE_SYNTAX}};
  for (const auto& [name, status] : wrong) {
    const auto& source = name;  // clang 14 captures no structured binding
    const std::string message = test::expect_failure(status, source, [&] { load(source); });
    EXPECT_TRUE(message.starts_with(source)) << message;
  }
}

TEST(Builtin, KeepsTheMemoryLimit) {
  test::expect_failure(SOBB_ERROR_MEMORY_LIMIT, "builtin:wool",
                       [] { load_scene("builtin:wool:1000000", nullptr, 10'000'000); });
}

}  // namespace
}  // namespace sobb
