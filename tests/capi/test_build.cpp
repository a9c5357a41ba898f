// SPDX-License-Identifier: Apache-2.0
// sobb_build(): the same bytes however it is run, extreme input, references, information.
#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "capi/handles.h"
#include "support/more_threads.h"
#include "support/sanitized.h"
#include "support/supported_isas.h"
#include "support/thread_pool.h"

namespace sobb::test {
namespace {

constexpr uint32_t kQualities[] = {SOBB_QUALITY_LOW, SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH};
constexpr uint32_t kVolumes[] = {SOBB_VOLUME_AABB, SOBB_VOLUME_SOBB};

// Which threads call the progress callback.
struct Threads {
  std::mutex mutex;
  std::set<std::thread::id> seen;

  static int note(void* user, double) {
    auto* self = static_cast<Threads*>(user);
    const std::scoped_lock lock(self->mutex);
    self->seen.insert(std::this_thread::get_id());
    return 0;
  }
};

TEST(Build, GivesTheSameBytesForAnyThreadsAndInstructionSet) {
  ThreadPool pool(3);
  const MoreThreads more(8);
  Threads threads;
  const std::vector<uint32_t> counts =
      kSanitized ? std::vector<uint32_t>{8} : std::vector<uint32_t>{1, 2, 3, 8, 0};
  for (const Soup& soup : {random_soup(1, 9'000), sliver_soup(2, 1'500), degenerate_soup(3, 1'000),
                           identical_soup(9'000), random_soup(4, 3)}) {
    for (const uint32_t quality : kQualities) {
      for (const uint32_t volume : kVolumes) {
        SCOPED_TRACE(soup.name + " quality " + std::to_string(quality) + " volume " +
                     std::to_string(volume));
        sobb_build_options options = build_options(volume, quality, 1);
        options.isa = SOBB_ISA_SSE4;
        const std::string expected = bytes_of(build_soup(soup, options));
        for (const sobb_isa isa : supported_isas()) {
          options.isa = isa;
          EXPECT_TRUE(bytes_of(build_soup(soup, options)) == expected) << sobb_isa_title(isa);
        }
        options.isa = SOBB_ISA_BEST;
        options.progress = Threads::note;
        options.progress_user = &threads;
        for (const uint32_t count : counts) {
          options.threads = count;
          EXPECT_TRUE(bytes_of(build_soup(soup, options)) == expected) << count << " threads";
        }
        const sobb_scheduler scheduler = pool.callback();
        options.scheduler = &scheduler;
        EXPECT_TRUE(bytes_of(build_soup(soup, options)) == expected) << "the caller's threads";
      }
    }
  }
  EXPECT_GT(threads.seen.size(), 4u) << "the builds did not run in parallel";
}

TEST(Build, DoesNotDependOnTheCallersFloatingPointControl) {
  const MoreThreads more(8);
  constexpr unsigned kOdd = 0x1F80 | _MM_FLUSH_ZERO_ON | 0x40 | _MM_ROUND_UP;
  for (const Soup& soup : {random_soup(1, 3'000, 0.8), placed(sliver_soup(2, 2'000), 1e-38, 0)}) {
    for (const uint32_t quality : kQualities) {
      for (const uint32_t threads : {1, 8}) {
        const sobb_build_options options = build_options(SOBB_VOLUME_SOBB, quality, threads);
        const std::string expected = bytes_of(build_soup(soup, options));
        const unsigned found = _mm_getcsr();
        _mm_setcsr(kOdd);
        const HierarchyHandle hierarchy = build_soup(soup, options);
        const unsigned after = _mm_getcsr();
        _mm_setcsr(found);
        EXPECT_EQ(after & 0xFFC0, kOdd & 0xFFC0);
        EXPECT_TRUE(bytes_of(hierarchy) == expected)
            << soup.name << " quality " << quality << " threads " << threads;
      }
    }
  }
}

TEST(Build, TakesAHundredThousandIdenticalTriangles) {
  const Soup soup = identical_soup(100'000);
  for (const uint32_t quality : kQualities) {
    const auto start = std::chrono::steady_clock::now();
    const HierarchyHandle hierarchy = build_soup(soup, build_options(0, quality));
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    EXPECT_LT(took.count(), 20) << "quality " << quality;
    const sobb_ray ray = {{0.25F, 0.25F, 1}, 0, {0, 0, -1}, 2};
    sobb_hit hit;
    ASSERT_EQ(sobb_intersect1(hierarchy.get(), &ray, &hit), SOBB_OK);
    EXPECT_EQ(hit.primitive, 0u);
    EXPECT_EQ(hit.t, 1);
  }
}

TEST(Build, TakesOneTriangle) {
  for (const uint32_t quality : kQualities) {
    for (const uint32_t volume : kVolumes) {
      const HierarchyHandle hierarchy =
          build_soup(identical_soup(1), build_options(volume, quality));
      const sobb_info info = info_of(hierarchy);
      EXPECT_EQ(info.nodes, 1u);
      EXPECT_EQ(info.leaves, 1u);
      EXPECT_EQ(info.depth, 1u);
      EXPECT_EQ(info.references, 1u);
    }
  }
}

TEST(Build, TakesManyThreads) {
  for (const uint32_t threads : {1000U, 1'000'000U, 0x80000000U, 0xFFFFFFFEU, 0xFFFFFFFFU}) {
    EXPECT_TRUE(build_soup(random_soup(5, 100), build_options(0, 0, threads))) << threads;
  }
}

// Vertices that crowd towards one point: deep topologies.
TEST(Build, TakesTrianglesInGeometricProgression) {
  Soup soup{"progression", {}, {}};
  float size = 1e17F;
  for (int i = 0; i < 3000; ++i, size *= 0.96F) {
    const float a[3] = {size, 0, 0};
    const float b[3] = {size, size * 0.01F, 0};
    const float c[3] = {size, 0, size * 0.01F};
    soup.add(a, b, c);
  }
  for (const uint32_t quality : kQualities) {
    EXPECT_TRUE(build_soup(soup, build_options(0, quality))) << "quality " << quality;
  }
}

TEST(Build, CountsReferences) {
  const HierarchyHandle hierarchy = build_soup(random_soup(6, 50));
  EXPECT_EQ(sobb_retain(hierarchy.get()), hierarchy.get());
  sobb_release(hierarchy.get());
  EXPECT_EQ(info_of(hierarchy).triangles, 50u);
  EXPECT_EQ(sobb_retain(nullptr), nullptr);
  sobb_release(nullptr);
}

TEST(Build, BorrowsItsInputForTheCallOnly) {
  Soup soup = random_soup(7, 500);
  const HierarchyHandle hierarchy = build_soup(soup);
  const std::string before = bytes_of(hierarchy);
  std::fill(soup.vertices.begin(), soup.vertices.end(), 0.0F);
  soup = {};
  EXPECT_TRUE(bytes_of(hierarchy) == before);
}

class Info : public testing::TestWithParam<Soup> {};

TEST_P(Info, IsConsistent) {
  const Soup& soup = GetParam();
  for (const uint32_t quality : kQualities) {
    for (const uint32_t volume : kVolumes) {
      for (const uint32_t width : {4U, 8U}) {
        sobb_build_options options = build_options(volume, quality);
        options.width = width;
        options.k = 48;
        options.strategy = SOBB_STRATEGY_K3;
        const sobb_info info = info_of(build_soup(soup, options));
        EXPECT_EQ(info.struct_size, sizeof info);
        EXPECT_EQ(info.format_version, 1u);
        EXPECT_EQ(info.volume, volume);
        EXPECT_EQ(info.k, volume == SOBB_VOLUME_AABB ? 6u : 48u);
        EXPECT_EQ(info.quality, quality);
        EXPECT_EQ(info.strategy, static_cast<uint32_t>(SOBB_STRATEGY_K3));
        EXPECT_EQ(info.width, width);
        EXPECT_EQ(info.triangles, soup.indices.size() / 3);
        EXPECT_LE(info.degenerate, info.triangles);
        EXPECT_GE(info.references, info.triangles);
        EXPECT_TRUE(quality == SOBB_QUALITY_HIGH || info.references == info.triangles);
        EXPECT_EQ(info.axes_nodes + info.shared_nodes + info.own_nodes, info.nodes);
        EXPECT_TRUE(volume == SOBB_VOLUME_SOBB || info.axes_nodes == info.nodes);
        EXPECT_GE(info.leaves, (info.references + 7) / 8);
        EXPECT_LE(info.leaves, info.references);
        EXPECT_GE(info.blocks, (info.references + 3) / 4);
        EXPECT_LE(info.blocks, info.references);
        EXPECT_EQ(info.node_bytes, info.nodes * 32 * width);
        EXPECT_EQ(info.triangle_bytes, info.blocks * 160);
        EXPECT_GT(info.bytes, info.node_bytes + info.triangle_bytes);
        EXPECT_LT(info.bytes, info.node_bytes + info.triangle_bytes + 2048);
        EXPECT_GE(info.nodes, info.depth);
        // A node but the root is one child, as is a leaf.
        EXPECT_LE(info.nodes - 1 + info.leaves, info.nodes * width);
        EXPECT_GE(info.inner_area, 0);
        EXPECT_GE(info.leaf_area, 0);
        EXPECT_LE(info.topology_ms + info.collapse_ms + info.volume_ms, info.total_ms * 1.001);
        EXPECT_GE(info.peak_bytes, info.bytes);
        for (int k = 0; k < 3; ++k) EXPECT_LE(info.bounds_min[k], info.bounds_max[k]);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Soups, Info,
                         testing::Values(random_soup(8, 2000), random_soup(9, 300, 1.5),
                                         sliver_soup(10, 1000), degenerate_soup(11, 500),
                                         identical_soup(200), closed_box(8),
                                         placed(random_soup(12, 200), 1e-40, 0)),
                         [](const testing::TestParamInfo<Soup>& info) {
                           return "soup" + std::to_string(info.index);
                         });

}  // namespace
}  // namespace sobb::test
