// SPDX-License-Identifier: Apache-2.0
// The caller's allocator sees every byte of a call and of its hierarchy, and the limit holds.
#include <gtest/gtest.h>

#include "capi/handles.h"
#include "format/temporary_folder.h"
#include "memory/library_memory.h"
#include "sobb/scene.h"
#include "support/more_threads.h"

namespace sobb::test {
namespace {

constexpr uint32_t kQualities[] = {SOBB_QUALITY_LOW, SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH};
// What a call keeps beside the caller's allocator: whom it asks, and how much it may.
constexpr uint64_t kBookkeeping = 512;

TEST(Accounts, AllocatorSeesEveryByte) {
  const MoreThreads more(4);
  const Soup soup = turned_boxes(1, 4000);
  const std::vector<sobb_ray> rays = mixed_rays(soup, 2, 5000);
  for (const uint32_t quality : kQualities) {
    for (const uint32_t threads : {1U, 3U}) {
      SCOPED_TRACE("quality " + std::to_string(quality) + " threads " + std::to_string(threads));
      LibraryMemory memory;
      sobb_build_options building = build_options(0, quality, threads);
      building.allocator = memory.allocator();
      {
        const HierarchyHandle built = build_soup(soup, building);
        EXPECT_GE(memory.through_allocator.peak, memory.through_allocator.bytes);
        EXPECT_GE(info_of(built).peak_bytes, memory.through_allocator.peak);
        // Threads account for a block before they ask for it.
        if (threads == 1) {
          EXPECT_EQ(info_of(built).peak_bytes, memory.through_allocator.peak);
        }
        trace(built, rays, trace_options(0, threads));

        const std::string bytes = bytes_of(built);
        sobb_open_options opening = {};
        opening.struct_size = sizeof opening;
        opening.threads = threads;
        opening.allocator = memory.allocator();
        sobb_hierarchy* opened = nullptr;
        ASSERT_EQ(sobb_open_memory(bytes.data(), bytes.size(), &opening, &opened), SOBB_OK);
        trace(HierarchyHandle(opened), rays, trace_options(0, threads));
      }
      EXPECT_LE(memory.by_new.peak, kBookkeeping);
      EXPECT_EQ(memory.by_new.bytes, 0u);
      EXPECT_EQ(memory.through_allocator.bytes, 0u);
    }
  }
}

// Limits from nothing to plenty.
std::vector<uint64_t> limits_up_to(uint64_t peak) {
  std::vector<uint64_t> limits = {1, peak - 1, peak};
  for (uint64_t limit = 64; limit < peak; limit *= 2) limits.push_back(limit);
  for (int part = 1; part < 40; ++part) limits.push_back(peak * part / 32);
  return limits;
}

TEST(Limit, OfBuildingIsKept) {
  const Soup soup = turned_boxes(3, 400);
  const sobb_triangles triangles = soup.view();
  for (const uint32_t quality : kQualities) {
    const uint64_t peak = info_of(build_soup(soup, build_options(0, quality))).peak_bytes;
    for (const uint64_t limit : limits_up_to(peak)) {
      SCOPED_TRACE("quality " + std::to_string(quality) + " limit " + std::to_string(limit) +
                   " of " + std::to_string(peak));
      LibraryMemory memory;
      sobb_build_options options = build_options(0, quality);
      options.allocator = memory.allocator();
      options.memory_limit = limit;
      sobb_hierarchy* out = nullptr;
      const sobb_status status = sobb_build(&triangles, &options, &out);
      const HierarchyHandle hierarchy(out);
      EXPECT_LE(memory.through_allocator.peak, limit);
      if (status == SOBB_OK) {
        EXPECT_LE(info_of(hierarchy).peak_bytes, limit);
      } else {
        EXPECT_EQ(status, SOBB_ERROR_MEMORY_LIMIT) << sobb_last_error();
        EXPECT_TRUE(limit < peak || quality == SOBB_QUALITY_LOW) << "it is enough";
        EXPECT_EQ(memory.through_allocator.bytes, 0u);
      }
    }
  }
}

TEST(Limit, OfOpeningIsKept) {
  const TemporaryFolder folder;
  const std::string bytes = bytes_of(build_soup(turned_boxes(4, 400)));
  const std::string path = folder.write("file.sobb", bytes);
  uint64_t peak = 0;
  const auto open_within = [&](uint64_t limit) {
    LibraryMemory memory;
    sobb_open_options options = {};
    options.struct_size = sizeof options;
    options.threads = 1;
    options.allocator = memory.allocator();
    options.memory_limit = limit;
    sobb_hierarchy* hierarchy = nullptr;
    const sobb_status status = sobb_open(path.c_str(), &options, &hierarchy);
    sobb_release(hierarchy);
    peak = memory.through_allocator.peak;
    return status;
  };
  ASSERT_EQ(open_within(0), SOBB_OK);
  const uint64_t enough = peak;
  for (const uint64_t limit : limits_up_to(enough)) {
    EXPECT_EQ(open_within(limit), limit < enough ? SOBB_ERROR_MEMORY_LIMIT : SOBB_OK) << limit;
    EXPECT_LE(peak, limit);
  }
}

TEST(Limit, OfLoadingASceneIsKept) {
  uint64_t peak = 0;
  const auto load_within = [&](uint64_t limit) {
    LibraryMemory memory;
    sobb_scene_options options = {};
    options.struct_size = sizeof options;
    options.memory_limit = limit;
    sobb_scene* scene = nullptr;
    const sobb_status status = sobb_scene_load("builtin:city:5000", &options, &scene);
    sobb_scene_release(scene);
    peak = memory.by_new.peak;
    return status;
  };
  ASSERT_EQ(load_within(0), SOBB_OK);
  for (const uint64_t limit : limits_up_to(peak)) {
    const sobb_status status = load_within(limit);
    EXPECT_TRUE(status == SOBB_OK || status == SOBB_ERROR_MEMORY_LIMIT) << limit;
    EXPECT_LE(peak, limit + (uint64_t{1} << 12)) << sobb_status_string(status);
  }
}

}  // namespace
}  // namespace sobb::test
