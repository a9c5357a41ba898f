// SPDX-License-Identifier: Apache-2.0
// sobb_build()'s options and failures: struct sizes, bad values, memory limit, allocator, progress
// and cancel. Whatever fails leaves the output alone and nothing behind.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <thread>

#include "capi/counting_allocator.h"
#include "capi/handles.h"
#include "support/more_threads.h"

namespace sobb::test {
namespace {

constexpr uint32_t kQualities[] = {SOBB_QUALITY_LOW, SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH};

sobb_hierarchy* const kUntouched = untouched_handle();

// A build that fails: the status; the message is the thread's, the output is as it was.
sobb_status failure_of(const sobb_triangles* triangles, const sobb_build_options* options) {
  sobb_hierarchy* out = kUntouched;
  const sobb_status status = sobb_build(triangles, options, &out);
  EXPECT_EQ(out, kUntouched);
  EXPECT_STRNE(sobb_last_error(), "");
  return status;
}

sobb_status failure_of(const Soup& soup, const sobb_build_options& options = build_options()) {
  const sobb_triangles triangles = soup.view();
  return failure_of(&triangles, &options);
}

TEST(BuildOptions, BadValuesAreNamed) {
  const Soup soup = random_soup(1, 10);
  const auto expect = [&](const std::function<void(sobb_build_options&)>& change,
                          const char* message) {
    sobb_build_options options = build_options();
    change(options);
    EXPECT_EQ(failure_of(soup, options), SOBB_ERROR_INVALID_ARGUMENT) << message;
    EXPECT_STREQ(sobb_last_error(), message);
  };
  expect([](auto& o) { o.volume = 3; }, "build options: volume is 3");
  expect([](auto& o) { o.quality = 4; }, "build options: quality is 4");
  expect([](auto& o) { o.strategy = 4; }, "build options: strategy is 4");
  expect([](auto& o) { o.k = 63; }, "build options: k is 63");
  expect([](auto& o) { o.k = 6; }, "build options: k is 6");
  expect([](auto& o) { o.width = 2; }, "build options: width is 2");
  expect([](auto& o) { o.width = 0xFFFFFFFF; }, "build options: width is 4294967295");
  expect([](auto& o) { o.isa = 0xFFFFFFFF; }, "isa is 4294967295, not a sobb_isa");
  expect([](auto& o) { o.struct_size = 0; }, "build options: struct_size is 0");
  expect([](auto& o) { o.struct_size = 3; }, "build options: struct_size is 3");
}

TEST(BuildOptions, NullArguments) {
  const Soup soup = random_soup(1, 10);
  const sobb_triangles triangles = soup.view();
  EXPECT_EQ(failure_of(nullptr, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(sobb_last_error(), "triangles is NULL");
  EXPECT_EQ(sobb_build(&triangles, nullptr, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(sobb_last_error(), "out is NULL");
  EXPECT_EQ(sobb_get_info(nullptr, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_resolve_isa(SOBB_ISA_BEST, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
  const HierarchyHandle hierarchy = build_soup(soup);
  EXPECT_EQ(sobb_get_info(hierarchy.get(), nullptr), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(sobb_last_error(), "info is NULL");
  EXPECT_EQ(sobb_bytes(hierarchy.get(), nullptr, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
}

TEST(BuildOptions, AllZeroAndNullAreTheDefaults) {
  const Soup soup = random_soup(2, 200);
  const sobb_triangles triangles = soup.view();
  sobb_build_options explicit_options = build_options(SOBB_VOLUME_SOBB, SOBB_QUALITY_MEDIUM);
  explicit_options.k = 64;
  explicit_options.strategy = SOBB_STRATEGY_K2;
  explicit_options.width = 8;
  const std::string expected = bytes_of(build_soup(soup, explicit_options));
  sobb_hierarchy* out = nullptr;
  ASSERT_EQ(sobb_build(&triangles, nullptr, &out), SOBB_OK);
  EXPECT_TRUE(bytes_of(HierarchyHandle(out)) == expected);
  EXPECT_TRUE(bytes_of(build_soup(soup)) == expected);
}

// An older caller: members beyond its struct_size are not read.
TEST(BuildOptions, AShorterStructHasDefaultsBeyond) {
  const Soup soup = random_soup(3, 200);
  sobb_build_options options = build_options(SOBB_VOLUME_AABB, SOBB_QUALITY_LOW);
  options.width = 4;
  const auto info_with = [&](size_t size) {
    options.struct_size = static_cast<uint32_t>(size);
    return info_of(build_soup(soup, options));
  };
  sobb_info info = info_with(offsetof(sobb_build_options, volume));
  EXPECT_EQ(info.volume, static_cast<uint32_t>(SOBB_VOLUME_SOBB));
  info = info_with(offsetof(sobb_build_options, k));  // covers volume, no more
  EXPECT_EQ(info.volume, static_cast<uint32_t>(SOBB_VOLUME_AABB));
  EXPECT_EQ(info.quality, static_cast<uint32_t>(SOBB_QUALITY_MEDIUM));
  info = info_with(offsetof(sobb_build_options, strategy));
  EXPECT_EQ(info.quality, static_cast<uint32_t>(SOBB_QUALITY_LOW));
  EXPECT_EQ(info.width, 8u);
  info = info_with(offsetof(sobb_build_options, threads));
  EXPECT_EQ(info.width, 4u);
  // Nonsense beyond the size is not looked at.
  options.memory_limit = 1;
  options.isa = 77;
  options.allocator = reinterpret_cast<const sobb_allocator*>(untouched_handle());
  EXPECT_EQ(info_with(offsetof(sobb_build_options, isa)).width, 4u);
}

TEST(BuildOptions, ALargerStructMustBeZeroBeyond) {
  const Soup soup = random_soup(4, 200);
  struct Larger {
    sobb_build_options known;
    unsigned char later[24];
  } options = {build_options(), {}};
  options.known.struct_size = sizeof options;
  EXPECT_TRUE(build_soup(soup, options.known));
  options.later[23] = 1;
  EXPECT_EQ(failure_of(soup, options.known), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(std::string(sobb_last_error()), "build options: byte " +
                                                std::to_string(sizeof options - 1) +
                                                " is set, beyond what this library knows");
}

TEST(BuildOptions, TrianglesHaveASizeToo) {
  const Soup soup = random_soup(5, 20);
  sobb_triangles triangles = soup.view();
  triangles.struct_size = 0;
  EXPECT_EQ(failure_of(&triangles, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(sobb_last_error(), "triangles: struct_size is 0");
  triangles.struct_size = offsetof(sobb_triangles, triangle_count);  // without its count: none
  EXPECT_EQ(failure_of(&triangles, nullptr), SOBB_ERROR_EMPTY);
}

TEST(BuildOptions, AShorterInfoIsFilledAsFarAsItGoes) {
  const HierarchyHandle hierarchy = build_soup(random_soup(6, 200));
  sobb_info info;
  std::memset(&info, 0xAB, sizeof info);
  info.struct_size = offsetof(sobb_info, nodes);
  ASSERT_EQ(sobb_get_info(hierarchy.get(), &info), SOBB_OK);
  EXPECT_EQ(info.struct_size, offsetof(sobb_info, nodes));
  EXPECT_EQ(info.triangles, 200u);
  EXPECT_EQ(info.nodes, 0xABABABABABABABAB);
  struct {
    sobb_info known;
    uint64_t later;
  } larger = {{}, 42};
  larger.known.struct_size = sizeof larger;
  ASSERT_EQ(sobb_get_info(hierarchy.get(), &larger.known), SOBB_OK);
  EXPECT_EQ(larger.known.triangles, 200u);
  EXPECT_EQ(larger.later, 42u);
}

TEST(BuildFailure, OfBadTriangles) {
  Soup soup = random_soup(7, 10);
  soup.indices[5] = 1000;
  EXPECT_EQ(failure_of(soup), SOBB_ERROR_INDEX);
  EXPECT_STREQ(sobb_last_error(), "triangle 1: vertex index 1000, but there are 30 vertices");
  soup.indices[5] = 5;
  soup.vertices[4] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(failure_of(soup), SOBB_ERROR_NOT_FINITE);
  soup.vertices[4] = 1e19F;
  EXPECT_EQ(failure_of(soup), SOBB_ERROR_TOO_LARGE);
  soup.indices.clear();
  EXPECT_EQ(failure_of(soup), SOBB_ERROR_EMPTY);
  EXPECT_STREQ(sobb_last_error(), "the mesh has no triangle");
}

TEST(BuildMemory, EveryBlockComesBackOnAnyThreads) {
  const Soup soup = random_soup(8, 3000);
  for (const uint32_t quality : kQualities) {
    for (const uint32_t threads : {1U, 3U}) {
      CountingAllocator counting;
      const sobb_allocator allocator = counting.callback();
      sobb_build_options options = build_options(0, quality, threads);
      options.allocator = &allocator;
      const HierarchyHandle hierarchy = build_soup(soup, options);
      EXPECT_GT(counting.calls(), 2u);
      EXPECT_LE(counting.blocks(), 2u) << "the hierarchy keeps itself and its image, no more";
      EXPECT_TRUE(bytes_of(hierarchy) == bytes_of(build_soup(soup, build_options(0, quality))));
    }
  }
}

TEST(BuildMemory, AnAllocatorMayFailAtAnyCall) {
  const Soup soup = random_soup(9, 500);
  const sobb_triangles triangles = soup.view();
  for (const uint32_t quality : {SOBB_QUALITY_LOW, SOBB_QUALITY_HIGH}) {
    uint64_t calls = 1;
    for (uint64_t at = 0; at < calls; ++at) {
      CountingAllocator counting(at);
      const sobb_allocator allocator = counting.callback();
      sobb_build_options options = build_options(0, quality);
      options.allocator = &allocator;
      ASSERT_EQ(failure_of(&triangles, &options), SOBB_ERROR_OUT_OF_MEMORY) << "call " << at;
      ASSERT_EQ(counting.blocks(), 0u) << "call " << at;
      if (at == 0) {
        CountingAllocator all;
        const sobb_allocator whole = all.callback();
        options.allocator = &whole;
        build_soup(soup, options);
        calls = all.calls();
      }
    }
  }
}

TEST(BuildMemory, KeepsTheLimitOnAnyThreads) {
  const MoreThreads more(8);
  const Soup soup = random_soup(10, 10'000);
  for (const uint32_t quality : kQualities) {
    sobb_build_options options = build_options(0, quality);
    const uint64_t peak = info_of(build_soup(soup, options)).peak_bytes;
    for (const uint64_t limit : {uint64_t{1}, uint64_t{1000}, uint64_t{1} << 16, uint64_t{1} << 18,
                                 peak / 4, peak / 2, peak * 3 / 4, peak - 1}) {
      CountingAllocator counting;
      const sobb_allocator allocator = counting.callback();
      options.allocator = &allocator;
      options.memory_limit = limit;
      EXPECT_EQ(failure_of(soup, options), SOBB_ERROR_MEMORY_LIMIT)
          << "quality " << quality << " limit " << limit << " of " << peak;
      EXPECT_EQ(std::string(sobb_last_error()).rfind("memory limit", 0), 0u) << sobb_last_error();
      EXPECT_EQ(counting.blocks(), 0u);
      options.threads = 9 - options.threads;  // 1 and 8
    }
    options.allocator = nullptr;
    options.threads = 1;
    options.memory_limit = peak + peak / 8;
    EXPECT_TRUE(build_soup(soup, options)) << "quality " << quality;
  }
}

// Notes what a progress callback sees; cancels at the n-th call.
struct Watch {
  uint64_t cancel_at = UINT64_MAX;
  uint64_t calls = 0;
  double last = 0;
  bool in_order = true;
  std::atomic<int> inside{0};
  bool alone = true;

  static int report(void* user, double fraction) {
    auto* self = static_cast<Watch*>(user);
    if (++self->inside != 1) self->alone = false;
    self->in_order = self->in_order && fraction >= self->last && fraction <= 1;
    self->last = fraction;
    const bool cancel = self->calls++ == self->cancel_at;
    --self->inside;
    return cancel ? 1 : 0;
  }
};

TEST(BuildProgress, RisesFromNoughtToOneOnAnyThreads) {
  const MoreThreads more(8);
  const Soup soup = random_soup(11, 20'000);
  for (const uint32_t quality : kQualities) {
    for (const uint32_t threads : {1U, 8U}) {
      Watch watch;
      sobb_build_options options = build_options(0, quality, threads);
      options.progress = Watch::report;
      options.progress_user = &watch;
      EXPECT_TRUE(build_soup(soup, options));
      EXPECT_TRUE(watch.in_order);
      EXPECT_TRUE(watch.alone);
      EXPECT_EQ(watch.last, 1) << "quality " << quality << " threads " << threads;
      EXPECT_GT(watch.calls, 3u);
    }
  }
}

TEST(BuildProgress, CancelsAtAnyCallOnAnyThreadsAndLeavesNothing) {
  const MoreThreads more(8);
  const Soup soup = random_soup(12, 6000);
  for (const uint32_t quality : kQualities) {
    for (const uint32_t threads : {1U, 4U}) {
      uint64_t calls = 1;
      for (uint64_t at = 0; at < calls; at += 1 + calls / 20) {
        CountingAllocator counting;
        const sobb_allocator allocator = counting.callback();
        Watch watch;
        watch.cancel_at = at;
        sobb_build_options options = build_options(0, quality, threads);
        options.allocator = &allocator;
        options.progress = Watch::report;
        options.progress_user = &watch;
        ASSERT_EQ(failure_of(soup, options), SOBB_ERROR_CANCELLED)
            << "quality " << quality << " threads " << threads << " call " << at;
        EXPECT_STREQ(sobb_last_error(), "the build was cancelled");
        EXPECT_EQ(watch.calls, at + 1) << "called again after it cancelled";
        EXPECT_EQ(counting.blocks(), 0u);
        if (at == 0 && threads == 1) {
          Watch whole;
          options.progress_user = &whole;
          build_soup(soup, options);
          calls = whole.calls;
        }
      }
    }
  }
}

TEST(LastError, IsTheThreadsOwnAndStays) {
  EXPECT_EQ(failure_of(nullptr, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
  build_soup(random_soup(13, 5));
  EXPECT_STREQ(sobb_last_error(), "triangles is NULL") << "a success leaves it alone";
  std::thread([] { EXPECT_STREQ(sobb_last_error(), ""); }).join();
}

}  // namespace
}  // namespace sobb::test
