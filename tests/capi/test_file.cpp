// SPDX-License-Identifier: Apache-2.0
// Save and open through the C ABI: the same bytes and hits; what cannot be opened says why.
#include <gtest/gtest.h>

#include <algorithm>

#include "capi/counting_allocator.h"
#include "capi/handles.h"
#include "format/temporary_folder.h"
#include "support/thread_pool.h"

namespace sobb::test {
namespace {

sobb_open_options open_options(uint32_t flags = 0) {
  sobb_open_options options = {};
  options.struct_size = sizeof options;
  options.flags = flags;
  options.threads = 1;
  return options;
}

HierarchyHandle open_file(const std::string& path, const sobb_open_options& options) {
  sobb_hierarchy* hierarchy = nullptr;
  EXPECT_EQ(sobb_open(path.c_str(), &options, &hierarchy), SOBB_OK) << sobb_last_error();
  return HierarchyHandle(hierarchy);
}

HierarchyHandle open_bytes(const std::string& bytes) {
  sobb_hierarchy* hierarchy = nullptr;
  EXPECT_EQ(sobb_open_memory(bytes.data(), bytes.size(), nullptr, &hierarchy), SOBB_OK)
      << sobb_last_error();
  return HierarchyHandle(hierarchy);
}

sobb_status failure_of(const std::string& path, const sobb_open_options& options = open_options()) {
  sobb_hierarchy* const untouched = untouched_handle();
  sobb_hierarchy* out = untouched;
  const sobb_status status = sobb_open(path.c_str(), &options, &out);
  EXPECT_EQ(out, untouched);
  EXPECT_NE(std::string(sobb_last_error()).find(path), std::string::npos) << sobb_last_error();
  return status;
}

class File : public testing::Test {
 protected:
  TemporaryFolder folder_;
  Soup soup_ = random_soup(41, 1500, 0.4);
};

TEST_F(File, SavedAndOpenedIsTheSame) {
  const std::vector<sobb_ray> rays = mixed_rays(soup_, 42, 1000);
  for (const uint32_t quality : {SOBB_QUALITY_LOW, SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH}) {
    for (const uint32_t volume : {SOBB_VOLUME_AABB, SOBB_VOLUME_SOBB}) {
      for (const uint32_t width : {4U, 8U}) {
        sobb_build_options options = build_options(volume, quality);
        options.width = width;
        const HierarchyHandle built = build_soup(soup_, options);
        const std::string expected = bytes_of(built);
        const std::string path = folder_.path("scene.sobb");
        ASSERT_EQ(sobb_save(built.get(), path.c_str()), SOBB_OK) << sobb_last_error();
        EXPECT_TRUE(folder_.read("scene.sobb") == expected);
        const std::vector<sobb_hit> hits = trace(built, rays);
        const sobb_info info = info_of(built);
        HierarchyHandle opened[] = {open_file(path, open_options()),
                                    open_file(path, open_options(SOBB_OPEN_MAP)),
                                    open_bytes(expected)};
        for (const HierarchyHandle& hierarchy : opened) {
          EXPECT_TRUE(bytes_of(hierarchy) == expected);
          EXPECT_TRUE(same(trace(hierarchy, rays), hits));
          const sobb_info again = info_of(hierarchy);
          EXPECT_EQ(again.source_hash, info.source_hash);
          EXPECT_EQ(again.leaf_area, info.leaf_area);
          EXPECT_EQ(again.quality, info.quality);
          EXPECT_EQ(again.total_ms, 0);
          EXPECT_EQ(again.peak_bytes, 0u);
        }
      }
    }
  }
  EXPECT_EQ(folder_.count(), 1) << "a temporary is left";
}

TEST_F(File, OpenedFromMemoryIsACopy) {
  const std::string before = bytes_of(build_soup(soup_));
  // At any alignment.
  for (size_t offset = 0; offset < 4; ++offset) {
    std::string shifted(offset, '\0');
    shifted += before;
    sobb_hierarchy* out = nullptr;
    ASSERT_EQ(sobb_open_memory(shifted.data() + offset, before.size(), nullptr, &out), SOBB_OK);
    const HierarchyHandle hierarchy(out);
    std::fill(shifted.begin(), shifted.end(), '\xFF');
    EXPECT_TRUE(bytes_of(hierarchy) == before);
  }
}

TEST_F(File, OpenedOutlivesAReplacedFile) {
  const std::string path = folder_.path("scene.sobb");
  const HierarchyHandle first = build_soup(soup_);
  const HierarchyHandle second = build_soup(random_soup(43, 10));
  ASSERT_EQ(sobb_save(first.get(), path.c_str()), SOBB_OK);
  const HierarchyHandle read = open_file(path, open_options());
  const HierarchyHandle mapped = open_file(path, open_options(SOBB_OPEN_MAP));
  ASSERT_EQ(sobb_save(second.get(), path.c_str()), SOBB_OK);
  EXPECT_TRUE(bytes_of(read) == bytes_of(first));
  EXPECT_TRUE(bytes_of(mapped) == bytes_of(first)) << "renamed over: the old file lives on";
  EXPECT_TRUE(bytes_of(open_file(path, open_options())) == bytes_of(second));
}

TEST_F(File, WhatCannotBeOpenedIsNamed) {
  for (const uint32_t flags : {0U, static_cast<uint32_t>(SOBB_OPEN_MAP)}) {
    const sobb_open_options options = open_options(flags);
    EXPECT_EQ(failure_of(folder_.path("missing.sobb"), options), SOBB_ERROR_FILE_OPEN);
    EXPECT_EQ(failure_of(folder_.path(""), options), SOBB_ERROR_FILE_OPEN) << "a folder";
    EXPECT_EQ(failure_of("/dev/null", options), SOBB_ERROR_FILE_OPEN) << "no regular file";
    EXPECT_EQ(failure_of(folder_.write("empty.sobb", ""), options), SOBB_ERROR_FORMAT_SIZE);
    EXPECT_EQ(failure_of(folder_.write("text.sobb", std::string(500, 'x')), options),
              SOBB_ERROR_FORMAT_MAGIC);
  }
}

TEST_F(File, TruncatedAnywhereIsRefused) {
  const std::string bytes = bytes_of(build_soup(random_soup(44, 60)));
  for (size_t size = 0; size < bytes.size(); size += 1 + size / 16) {
    const std::string path = folder_.write("short.sobb", bytes.substr(0, size));
    EXPECT_EQ(failure_of(path), SOBB_ERROR_FORMAT_SIZE) << size << " bytes";
    EXPECT_EQ(failure_of(path, open_options(SOBB_OPEN_MAP)), SOBB_ERROR_FORMAT_SIZE);
  }
  EXPECT_EQ(failure_of(folder_.write("long.sobb", bytes + "x")), SOBB_ERROR_FORMAT_SIZE);
}

TEST_F(File, RandomBytesAreRefused) {
  constexpr uint64_t kSeed = 45;
  Random random(kSeed);
  const std::string bytes = bytes_of(build_soup(random_soup(46, 60)));
  for (int round = 0; round < 300; ++round) {
    std::string damaged = bytes;
    for (uint32_t i = 1 + random.below(8); i > 0; --i) {
      damaged[random.below(static_cast<uint32_t>(bytes.size()))] ^=
          static_cast<char>(1 + random.below(255));
    }
    if (damaged == bytes) continue;
    EXPECT_GE(failure_of(folder_.write("damaged.sobb", damaged)), SOBB_ERROR_FORMAT_MAGIC)
        << "seed " << kSeed << " round " << round;
    sobb_hierarchy* out = nullptr;
    EXPECT_GE(sobb_open_memory(damaged.data(), damaged.size(), nullptr, &out),
              SOBB_ERROR_FORMAT_MAGIC);
    EXPECT_EQ(std::string(sobb_last_error()).rfind("memory: ", 0), 0u) << sobb_last_error();
  }
}

TEST_F(File, MemoryLimitAndAllocatorHold) {
  const HierarchyHandle built = build_soup(soup_);
  const uint64_t size = bytes_of(built).size();
  const std::string path = folder_.path("scene.sobb");
  ASSERT_EQ(sobb_save(built.get(), path.c_str()), SOBB_OK);
  CountingAllocator counting;
  const sobb_allocator allocator = counting.callback();
  sobb_open_options options = open_options();
  options.allocator = &allocator;
  for (const uint64_t limit : {uint64_t{1}, uint64_t{1000}, size / 2, size - 1, size}) {
    options.memory_limit = limit;
    sobb_hierarchy* out = nullptr;
    EXPECT_EQ(sobb_open(path.c_str(), &options, &out), SOBB_ERROR_MEMORY_LIMIT) << limit;
    EXPECT_EQ(out, nullptr);
    EXPECT_EQ(counting.blocks(), 0u);
  }
  options.memory_limit = 2 * size;
  {
    const HierarchyHandle opened = open_file(path, options);
    EXPECT_GE(counting.blocks(), 1u);
  }
  EXPECT_EQ(counting.blocks(), 0u);
  options.flags = SOBB_OPEN_MAP;
  options.memory_limit = size / 4;
  EXPECT_TRUE(open_file(path, options)) << "a mapping takes none to speak of";
  for (uint64_t at = 0; at < 3; ++at) {
    CountingAllocator failing(at);
    const sobb_allocator callback = failing.callback();
    sobb_open_options starved = open_options();
    starved.allocator = &callback;
    sobb_hierarchy* out = nullptr;
    const sobb_status status = sobb_open(path.c_str(), &starved, &out);
    EXPECT_TRUE(status == SOBB_ERROR_OUT_OF_MEMORY || at >= failing.calls()) << "call " << at;
    sobb_release(out);
  }
}

TEST_F(File, ThreadsAndSchedulersOpenTheSame) {
  const HierarchyHandle built = build_soup(random_soup(47, 30'000));
  const std::string bytes = bytes_of(built);
  ThreadPool pool(3);
  const sobb_scheduler scheduler = pool.callback();
  for (const uint32_t threads : {0U, 1U, 3U, 0xFFFFFFFFU}) {
    sobb_open_options options = open_options();
    options.threads = threads;
    options.scheduler = threads == 3 ? &scheduler : nullptr;
    sobb_hierarchy* out = nullptr;
    ASSERT_EQ(sobb_open_memory(bytes.data(), bytes.size(), &options, &out), SOBB_OK);
    EXPECT_TRUE(bytes_of(HierarchyHandle(out)) == bytes);
  }
}

TEST_F(File, BadArgumentsAreRefused) {
  const HierarchyHandle built = build_soup(soup_);
  const std::string bytes = bytes_of(built);
  sobb_hierarchy* out = nullptr;
  EXPECT_EQ(sobb_save(nullptr, "x"), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_save(built.get(), nullptr), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_open(nullptr, nullptr, &out), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_open("x", nullptr, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_open_memory(nullptr, 5, nullptr, &out), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_open_memory(bytes.data(), bytes.size(), nullptr, nullptr),
            SOBB_ERROR_INVALID_ARGUMENT);
  sobb_open_options options = open_options(SOBB_OPEN_MAP);
  EXPECT_EQ(sobb_open_memory(bytes.data(), bytes.size(), &options, &out),
            SOBB_ERROR_INVALID_ARGUMENT);
  options = open_options(2);
  EXPECT_EQ(sobb_open("x", &options, &out), SOBB_ERROR_INVALID_ARGUMENT);
  options = open_options();
  options.reserved = 1;
  EXPECT_EQ(sobb_open("x", &options, &out), SOBB_ERROR_INVALID_ARGUMENT);
  options = open_options();
  options.struct_size = 1;
  EXPECT_EQ(sobb_open("x", &options, &out), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_open_memory(bytes.data(), 0, nullptr, &out), SOBB_ERROR_FORMAT_SIZE);
  options = open_options();
  options.memory_limit = 1 << 30;
  EXPECT_EQ(sobb_open_memory(bytes.data(), UINT64_MAX, &options, &out), SOBB_ERROR_MEMORY_LIMIT);
  EXPECT_EQ(out, nullptr);
}

TEST_F(File, SavingWhereOneCannotLeavesAllAsItWas) {
  const HierarchyHandle built = build_soup(soup_);
  const std::string missing = folder_.path("missing/scene.sobb");
  EXPECT_EQ(sobb_save(built.get(), missing.c_str()), SOBB_ERROR_FILE_WRITE);
  EXPECT_NE(std::string(sobb_last_error()).find(missing), std::string::npos);
  EXPECT_EQ(sobb_save(built.get(), folder_.path("").c_str()), SOBB_ERROR_FILE_WRITE);
  EXPECT_EQ(sobb_save(built.get(), ""), SOBB_ERROR_FILE_WRITE);
  EXPECT_EQ(folder_.count(), 0);
}

}  // namespace
}  // namespace sobb::test
