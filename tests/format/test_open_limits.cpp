// SPDX-License-Identifier: Apache-2.0
// Opening asks the caller whether to go on, however large and hostile the file is.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "format/checksum.h"
#include "format/small_file.h"
#include "format/temporary_folder.h"
#include "sobb/sobb.h"

namespace sobb {
namespace {

using Clock = std::chrono::steady_clock;
using test::TemporaryFolder;

// A caller that cancels at its n-th call, or once a time has passed.
struct Caller {
  uint64_t stop_at = UINT64_MAX;
  Clock::time_point deadline = Clock::time_point::max();
  std::vector<double> told = {};

  static int on_progress(void* user, double fraction) {
    auto* const self = static_cast<Caller*>(user);
    self->told.push_back(fraction);
    return self->told.size() >= self->stop_at || Clock::now() >= self->deadline ? 1 : 0;
  }
  sobb_open_options options(uint32_t flags = 0) {
    sobb_open_options options = {};
    options.struct_size = sizeof options;
    options.flags = flags;
    options.threads = 2;
    options.progress = on_progress;
    options.progress_user = this;
    return options;
  }
};

TEST(OpenLimits, ProgressRisesToOne) {
  const TemporaryFolder folder;
  test::SmallFile chain = test::make_comb(8, 90, 45);
  const std::string path = folder.path("scene.sobb");
  save_atomically(chain.bytes(), path.c_str());
  for (const uint32_t flags : {0u, static_cast<uint32_t>(SOBB_OPEN_MAP)}) {
    Caller caller;
    const sobb_open_options options = caller.options(flags);
    sobb_hierarchy* hierarchy = nullptr;
    ASSERT_EQ(sobb_open(path.c_str(), &options, &hierarchy), SOBB_OK) << sobb_last_error();
    sobb_release(hierarchy);
    ASSERT_FALSE(caller.told.empty());
    EXPECT_TRUE(std::ranges::is_sorted(caller.told));
    EXPECT_GE(caller.told.front(), 0);
    EXPECT_EQ(caller.told.back(), 1);
  }
}

TEST(OpenLimits, MayBeCancelledAtEveryCall) {
  test::SmallFile file = test::make_small_file(SOBB_VOLUME_SOBB, 8);
  uint64_t calls = 0;
  for (uint64_t stop_at = 1;; ++stop_at) {
    Caller caller{stop_at};
    const sobb_open_options options = caller.options();
    sobb_hierarchy* hierarchy = nullptr;
    const sobb_status status =
        sobb_open_memory(file.bytes().data(), file.bytes().size(), &options, &hierarchy);
    if (status == SOBB_OK) {
      calls = caller.told.size();
      sobb_release(hierarchy);
      break;
    }
    EXPECT_EQ(status, SOBB_ERROR_CANCELLED);
    EXPECT_STREQ(sobb_last_error(), "opening was cancelled");
    EXPECT_EQ(hierarchy, nullptr);
    EXPECT_EQ(caller.told.size(), stop_at) << "called again after it asked to stop";
  }
  EXPECT_GE(calls, 6u);  // the bytes, each section, blocks, nodes, tree
}

// The header of a good file is followed by zeros without end, in a section that no reader knows or
// in none. The file is sparse on the disk, but to check it takes minutes.
TEST(OpenLimits, AHugeFileIsGivenUpInTime) {
  constexpr uint64_t kHuge = uint64_t{1} << 39;
  const TemporaryFolder folder;
  const std::string path = folder.path("huge.sobb");
  for (const bool in_section : {false, true}) {
    test::SmallFile file = test::make_small_file(SOBB_VOLUME_AABB, 4);
    file.header().total_size = kHuge;
    // The last section, of the blocks, reaches to the end.
    Section& last = file.sections().back();
    if (in_section) {
      last.size = (kHuge - last.offset) / sizeof(TriangleBlock) * sizeof(TriangleBlock);
    }
    const size_t front = sizeof(FileHeader) + file.sections().size_bytes();
    file.header().header_checksum = header_checksum(file.bytes().first(front));
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(file.bytes().data()),
               static_cast<std::streamsize>(file.bytes().size()));
    std::error_code error;
    std::filesystem::resize_file(path, kHuge, error);
    if (error) GTEST_SKIP() << "this file system has no so large files: " << error.message();

    Caller caller{.deadline = Clock::now() + std::chrono::milliseconds(50)};
    const sobb_open_options options = caller.options(SOBB_OPEN_MAP);
    sobb_hierarchy* hierarchy = nullptr;
    const auto start = Clock::now();
    EXPECT_EQ(sobb_open(path.c_str(), &options, &hierarchy), SOBB_ERROR_CANCELLED)
        << sobb_last_error();
    EXPECT_LT(Clock::now() - start, std::chrono::seconds(5)) << "a loaded machine, or a defect";
  }
}

}  // namespace
}  // namespace sobb
