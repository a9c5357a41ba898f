// SPDX-License-Identifier: Apache-2.0
// Every allocation of the library fails once: the call says so, or does without it, nothing leaks,
// and the next try works.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <tuple>

#include "capi/handles.h"
#include "format/temporary_folder.h"
#include "memory/library_memory.h"
#include "sobb/scene.h"

namespace sobb::test {
namespace {

using Call = std::function<sobb_status(const sobb_allocator*)>;

// Makes `call`, which leaves nothing behind, as often as it allocates, the next allocation failing
// each time. Returns how often that was.
uint64_t fail_each(const Call& call) {
  for (uint64_t at = 0;; ++at) {
    sobb_status status = SOBB_OK;
    bool failed = false;
    {
      LibraryMemory memory(at);
      status = call(memory.allocator());
      failed = memory.failed();
      EXPECT_EQ(memory.through_allocator.blocks, 0u) << "failed allocation " << at;
      EXPECT_EQ(memory.by_new.blocks, 0u) << "failed allocation " << at;
    }
    EXPECT_TRUE(status == SOBB_OK || (failed && status == SOBB_ERROR_OUT_OF_MEMORY))
        << "failed allocation " << at << ": " << sobb_last_error();
    LibraryMemory plenty;
    EXPECT_EQ(call(plenty.allocator()), SOBB_OK) << "after allocation " << at << " had failed";
    if (!failed || testing::Test::HasFailure()) return at;
  }
}

void report(uint64_t tried) {
  testing::Test::RecordProperty("failing_allocations", static_cast<int>(tried));
#ifndef SOBB_SANITIZED  // else operator new does not fail
  EXPECT_GT(tried, 0u);
#endif
}

// Without an allocation that would count.
bool same_bytes(const HierarchyHandle& a, const HierarchyHandle& b) {
  const void* data[2] = {};
  uint64_t size[2] = {};
  return sobb_bytes(a.get(), &data[0], &size[0]) == SOBB_OK &&
         sobb_bytes(b.get(), &data[1], &size[1]) == SOBB_OK && size[0] == size[1] &&
         std::memcmp(data[0], data[1], size[0]) == 0;
}

class FailingBuild : public testing::TestWithParam<std::tuple<uint32_t, uint32_t>> {};

TEST_P(FailingBuild, IsAStatus) {
  const auto [volume, quality] = GetParam();
  const Soup soup = turned_boxes(1, 12);
  const sobb_triangles triangles = soup.view();
  sobb_build_options options = build_options(volume, quality);
  const HierarchyHandle expected = build_soup(soup, options);
  report(fail_each([&](const sobb_allocator* allocator) {
    options.allocator = allocator;
    sobb_hierarchy* hierarchy = nullptr;
    const sobb_status status = sobb_build(&triangles, &options, &hierarchy);
    const HierarchyHandle built(hierarchy);
    EXPECT_TRUE(status != SOBB_OK || same_bytes(built, expected));
    return status;
  }));
}

INSTANTIATE_TEST_SUITE_P(All, FailingBuild,
                         testing::Combine(testing::Values(SOBB_VOLUME_AABB, SOBB_VOLUME_SOBB),
                                          testing::Values(SOBB_QUALITY_LOW, SOBB_QUALITY_MEDIUM,
                                                          SOBB_QUALITY_HIGH)));

class FailingUse : public testing::Test {
 protected:
  const Soup soup_ = turned_boxes(2, 30);
  const HierarchyHandle hierarchy_ = build_soup(soup_);
  const TemporaryFolder folder_;
  const std::string path_ = folder_.path("file.sobb");
};

TEST_F(FailingUse, OpeningIsAStatus) {
  const std::string bytes = bytes_of(hierarchy_);
  folder_.write("file.sobb", bytes);
  sobb_open_options options = {};
  options.struct_size = sizeof options;
  options.threads = 1;
  const auto open = [&](const auto& call) {
    return [&options, call](const sobb_allocator* allocator) {
      options.allocator = allocator;
      sobb_hierarchy* opened = nullptr;
      const sobb_status status = call(&opened);
      sobb_release(opened);
      return status;
    };
  };
  const auto from_file = [&](sobb_hierarchy** out) {
    return sobb_open(path_.c_str(), &options, out);
  };
  const auto from_memory = [&](sobb_hierarchy** out) {
    return sobb_open_memory(bytes.data(), bytes.size(), &options, out);
  };
  report(fail_each(open(from_file)));
  report(fail_each(open(from_memory)));
  options.flags = SOBB_OPEN_MAP;
  report(fail_each(open(from_file)));
}

TEST_F(FailingUse, SavingIsAStatusAndKeepsTheOldFile) {
  const std::string old = "the old file";
  report(fail_each([&](const sobb_allocator*) {
    folder_.write("file.sobb", old);
    const sobb_status status = sobb_save(hierarchy_.get(), path_.c_str());
    EXPECT_EQ(folder_.read("file.sobb") == old, status != SOBB_OK);
    EXPECT_EQ(folder_.count(), 1);
    return status;
  }));
}

// Without a batch's memory an array is traced ray by ray.
TEST_F(FailingUse, TracingDoesWithout) {
  const std::vector<sobb_ray> rays = mixed_rays(soup_, 3, 3000);
  const std::vector<sobb_hit> expected = trace(hierarchy_, rays);
  bool failed = true;
  uint64_t tried = 0;
  for (; failed; ++tried) {
    LibraryMemory memory;
    sobb_build_options options = build_options();
    options.allocator = memory.allocator();
    const HierarchyHandle hierarchy = build_soup(soup_, options);
    const uint64_t kept = memory.through_allocator.blocks;
    memory.fail_after(tried);
    EXPECT_TRUE(same(trace(hierarchy, rays), expected)) << "failed allocation " << tried;
    failed = memory.failed();
    EXPECT_EQ(memory.through_allocator.blocks, kept);
  }
  report(tried - 1);
}

// A triangle in each format but glTF, and a scene made here. (The JSON library takes memory where
// it frees a document, and ends the process where there is none.)
struct Source {
  std::string name;
  std::string text;
};

const Source kSources[] = {
    {"triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
    {"triangle.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
    {"triangle.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
     "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
     "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
    {"triangle.stl",
     "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
     "endloop\nendfacet\nendsolid one\n"},
    {"turned.obj@30", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
    {"refined.obj^16", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
    {"builtin:pipes:500", ""}};

class FailingScene : public testing::TestWithParam<Source> {};

TEST_P(FailingScene, IsAStatus) {
  const auto& [name, text] = GetParam();
  const TemporaryFolder folder;
  const size_t suffix = std::min(name.size(), name.find_first_of("^@"));
  const std::string source =
      text.empty() ? name : folder.write(name.substr(0, suffix), text) + name.substr(suffix);
  report(fail_each([&](const sobb_allocator*) {
    sobb_scene* scene = nullptr;
    const sobb_status status = sobb_scene_load(source.c_str(), nullptr, &scene);
    sobb_scene_release(scene);
    return status;
  }));
}

INSTANTIATE_TEST_SUITE_P(Sources, FailingScene, testing::ValuesIn(kSources));

}  // namespace
}  // namespace sobb::test
