// SPDX-License-Identifier: Apache-2.0
// Limits of memory and time hold while a scene loads, also for small files that ask for much. (That
// the limit of memory holds to the byte is what the fuzzers' corpus shows under AddressSanitizer.)
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "format/temporary_folder.h"
#include "scene/gltf_testing.h"
#include "scene/input/json.h"
#include "scene/text/obj.h"
#include "scene/views/views_file.h"
#include "sobb/scene.h"

namespace sobb {
namespace {

using gltf_testing::GltfFile;
using gltf_testing::json;
using test::TemporaryFolder;

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

// Reads under a limit that the scene itself would keep, and that its reader must not exceed.
template <class Read>
void expect_limited(uint64_t limit, const std::string& bytes, const Read& read) {
  SCOPED_TRACE(bytes.substr(0, 100));
  Scene scene;
  SceneWriter writer("scene", limit, scene);
  test::expect_failure(SOBB_ERROR_MEMORY_LIMIT, "", [&] { read(bytes, writer); });
}

TEST(Limits, JsonIsHeldAgainstTheLimitBeforeItIsParsed) {
  for (const char* element : {"{},", "[],", "1,", "\"\",", "{\"a\":1},"}) {
    const std::string list = repeated(element, 10'000) + "0]}";
    expect_limited(200'000, R"({"asset":{"version":"2.0"},"extras":[)" + list, read_gltf);
  }
  // TinyGLTF's structs are larger than the tree.
  const std::string nodes =
      R"({"asset":{"version":"2.0"},"nodes":[)" + repeated("{},", 999) + "{}]}";
  expect_limited(1'000'000, nodes, read_gltf);
  expect_limited(10'000, '"' + std::string(5000, 'x') + '"', read_gltf);
}

TEST(Limits, ViewsAreHeldAgainstTheLimitToo) {
  const std::string views = "{\"a\":[" + repeated("[],", 10'000) + "0]}";
  expect_limited(200'000, views, [](const std::string& bytes, SceneWriter& writer) {
    parse_views(bytes, "cameras.json", "b", writer);
  });
}

TEST(Limits, WithoutALimitJsonHasFourGiB) {
  Scene scene;
  const SceneWriter writer("scene", 0, scene);
  EXPECT_NO_THROW(check_json_room(uint64_t{4} << 30, "scene", writer));
  EXPECT_THROW(check_json_room((uint64_t{4} << 30) + 1, "scene", writer), Error);
}

TEST(Limits, CountsWhatAccessorsHold) {
  GltfFile file;
  for (int i = 0; i < 20; ++i) {
    const size_t zeros =
        file.add("accessors", {{"componentType", 5126}, {"count", 30'000}, {"type", "VEC3"}});
    file.add_root({{"mesh", file.add_mesh(zeros)}});
  }
  expect_limited(2'000'000, file.glb(), read_gltf);
  for (int i = 0; i < 20; ++i) {
    file.add_root({{"mesh", i}});  // each mesh once more, with as many zeros as before
  }
  EXPECT_NO_THROW(gltf_testing::read(file));
  for (json& accessor : file.document["accessors"]) accessor["count"] = 60'000;
  gltf_testing::expect_error(file, SOBB_ERROR_SCENE_SYNTAX, "has no bufferView");
}

TEST(Limits, CountsNamesAndCorners) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  expect_limited(100'000, triangle + repeated("g x\nf 1 2 3\n", 2000), read_obj);
  expect_limited(100'000, triangle + "g " + std::string(100'000, 'x') + "\nf 1 2 3\n", read_obj);
  expect_limited(100'000, triangle + "f" + repeated(" 1", 20'000), read_obj);
}

// A caller of the C interface that keeps what progress it is fractions, and cancels at one call.
struct Caller {
  uint64_t stop_at = UINT64_MAX;
  std::vector<double> fractions = {};

  static int on_progress(void* user, double fraction) {
    auto* const self = static_cast<Caller*>(user);
    self->fractions.push_back(fraction);
    return self->fractions.size() >= self->stop_at ? 1 : 0;
  }
  sobb_scene_options options() {
    sobb_scene_options options = {};
    options.struct_size = sizeof options;
    options.progress = on_progress;
    options.progress_user = this;
    return options;
  }
};

// One scene per kind of reader, large enough that progress is reported on the way.
std::vector<std::string> large_scenes(const TemporaryFolder& folder) {
  GltfFile gltf = gltf_testing::square();
  for (int i = 0; i < 20'000; ++i) gltf.add_root({{"mesh", 0}});
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  return {folder.write("a.obj", vertices + repeated("# nothing\n", 300'000) + "f 1 2 3\n"),
          folder.write("b.obj", vertices + repeated("f 1 2 3\n", 100'000)),
          folder.write("a.glb", gltf.glb()),
          "builtin:city:100000",
          "builtin:city:100000@30",
          "builtin:city:4000^16"};
}

TEST(Limits, ProgressRisesAndMayCancelAtAnyCall) {
  const TemporaryFolder folder;
  for (const std::string& source : large_scenes(folder)) {
    SCOPED_TRACE(source);
    Caller all;
    sobb_scene_options options = all.options();
    sobb_scene* scene = nullptr;
    ASSERT_EQ(sobb_scene_load(source.c_str(), &options, &scene), SOBB_OK) << sobb_last_error();
    sobb_scene_release(scene);
    EXPECT_GE(all.fractions.size(), 3u);
    EXPECT_TRUE(std::ranges::is_sorted(all.fractions));
    EXPECT_GE(all.fractions.front(), 0);
    EXPECT_LE(all.fractions.back(), 1);
    // Calls come by the clock: a quicker load makes fewer of them.
    for (uint64_t stop_at = 1; stop_at == 1 || stop_at <= all.fractions.size() / 2; stop_at *= 2) {
      Caller caller{stop_at};
      options = caller.options();
      scene = nullptr;
      EXPECT_EQ(sobb_scene_load(source.c_str(), &options, &scene), SOBB_ERROR_CANCELLED);
      EXPECT_STREQ(sobb_last_error(), "loading was cancelled");
      EXPECT_EQ(scene, nullptr);
    }
  }
}

}  // namespace
}  // namespace sobb
