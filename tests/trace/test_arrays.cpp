// SPDX-License-Identifier: Apache-2.0
// Arrays of rays, which are traced in whichever mode is the fastest: by each, and as a call chooses
// among them, the same bits as ray by ray and the oracle, whatever the arrays' lengths, the rays'
// octants, and the room that lists find; and with a host that has no memory for them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "capi/counting_allocator.h"
#include "capi/handles.h"
#include "capi/random_bases.h"
#include "hierarchy.h"
#include "support/hostile_rays.h"
#include "support/scratch.h"
#include "support/soups.h"
#include "support/supported_isas.h"
#include "support/thread_pool.h"

namespace sobb::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// These counts lie about the fewest rays that are traced together, and the most of a task.
constexpr size_t kLengths[] = {1, 255, 256, 257, 2047, 2048, 2049, 5000};

struct Case {
  uint32_t k;  // 0: AABB
  uint32_t width;
};

sobb_build_options options_of(const Case& which) {
  sobb_build_options options =
      build_options(which.k == 0 ? SOBB_VOLUME_AABB : SOBB_VOLUME_SOBB, SOBB_QUALITY_MEDIUM);
  options.k = which.k;
  options.width = which.width;
  return options;
}

std::vector<sobb_hit> one_by_one(const HierarchyHandle& hierarchy,
                                 const std::vector<sobb_ray>& rays) {
  std::vector<sobb_hit> hits(rays.size());
  for (size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(sobb_intersect1(hierarchy.get(), &rays[i], &hits[i]), SOBB_OK);
  }
  return hits;
}

uint8_t occlusion(const sobb_hit& hit) {
  if (hit.primitive == SOBB_INVALID) return SOBB_OCCLUDED_INVALID;
  return hit.primitive == SOBB_MISS ? SOBB_FREE : SOBB_OCCLUDED;
}

// Closest and any hits of the first `count` rays, by some calls that return how many are invalid.
template <class Intersect, class Occluded>
void expect_hits_by(const Intersect& intersect, const Occluded& occluded, size_t count,
                    const std::vector<sobb_hit>& expected) {
  uint64_t invalid = 0;
  for (size_t i = 0; i < count; ++i) invalid += expected[i].primitive == SOBB_INVALID;
  const sobb_hit untouched = {-7, 0, 0, 0, 0, 0};
  std::vector<sobb_hit> hits(count + 1, untouched);
  ASSERT_EQ(intersect(hits.data()), invalid);
  std::vector<uint8_t> any(count + 1, 77);
  ASSERT_EQ(occluded(any.data()), invalid);
  for (size_t i = 0; i < count; ++i) {
    ASSERT_TRUE(same(hits[i], expected[i]))
        << "ray " << i << " of " << count << " hits " << hits[i].primitive << " at " << hits[i].t
        << ", not " << expected[i].primitive << " at " << expected[i].t;
    ASSERT_EQ(any[i], occlusion(expected[i])) << "ray " << i;
  }
  ASSERT_TRUE(same(hits[count], untouched)) << "written past the end";
  ASSERT_EQ(any[count], 77) << "written past the end";
}

// Expects the hits of each mode alone.
void expect_hits_of_modes(sobb_isa isa, const HierarchyHandle& hierarchy,
                          const std::vector<sobb_ray>& rays, size_t count,
                          const std::vector<sobb_hit>& expected) {
  const TraceKernels& kernels = trace_kernels(isa);
  for (size_t mode = 0; mode < kTraceModes; ++mode) {
    SCOPED_TRACE("mode " + std::to_string(mode));
    const auto trace = [&](auto* results, auto kernel) {
      uint64_t invalid = 0;
      for (size_t first = 0; first < count; first += kBatchRays) {
        const size_t some = std::min<size_t>(kBatchRays, count - first);
        const Scratch scratch(kernels.scratch_bytes);
        invalid +=
            kernel(hierarchy->tracer, rays.data() + first, some, results + first, scratch.get());
      }
      return invalid;
    };
    expect_hits_by([&](sobb_hit* hits) { return trace(hits, kernels.intersect_array[mode]); },
                   [&](uint8_t* any) { return trace(any, kernels.occluded_array[mode]); }, count,
                   expected);
    if (testing::Test::HasFatalFailure()) return;
  }
}

// Expects what array calls promise.
void expect_hits_of_calls(sobb_isa isa, const HierarchyHandle& hierarchy,
                          const std::vector<sobb_ray>& rays, size_t count,
                          const std::vector<sobb_hit>& expected, sobb_trace_options options) {
  uint64_t invalid = 12345;
  options.isa = isa;
  options.invalid_rays = &invalid;
  for (const uint32_t flags : {0U, static_cast<uint32_t>(SOBB_TRACE_COHERENT)}) {
    SCOPED_TRACE("flags " + std::to_string(flags));
    options.flags = flags;
    const auto call = [&](auto function, auto* results) {
      EXPECT_EQ(function(hierarchy.get(), rays.data(), count, results, &options), SOBB_OK);
      return invalid;
    };
    expect_hits_by([&](sobb_hit* hits) { return call(sobb_intersect, hits); },
                   [&](uint8_t* any) { return call(sobb_occluded, any); }, count, expected);
    if (testing::Test::HasFatalFailure()) return;
  }
}

// Expects the same from every instruction set. With threads or a host that is short of memory only
// calls are tried.
void expect_hits(const HierarchyHandle& hierarchy, const std::vector<sobb_ray>& rays, size_t count,
                 const std::vector<sobb_hit>& expected, const std::string& what,
                 const sobb_trace_options* options = nullptr) {
  SCOPED_TRACE(what);
  for (const sobb_isa isa : supported_isas()) {
    SCOPED_TRACE("isa " + std::to_string(isa));
    if (options == nullptr) expect_hits_of_modes(isa, hierarchy, rays, count, expected);
    if (testing::Test::HasFatalFailure()) return;
    expect_hits_of_calls(isa, hierarchy, rays, count, expected,
                         options == nullptr ? trace_options() : *options);
    if (testing::Test::HasFatalFailure()) return;
  }
}

// Rays from about the unit cube towards points of it, in one octant: the signs are its bits, and a
// component in eight is nought of that sign.
std::vector<sobb_ray> octant_rays(uint32_t octant, uint32_t count, Random& random) {
  std::vector<sobb_ray> rays(count);
  for (sobb_ray& ray : rays) {
    ray.tmin = random.below(8) == 0 ? random.between(0, 0.5) : 0;
    ray.tmax = random.below(4) == 0 ? random.between(0, 2) : kInfinity;
    const uint32_t kept = random.below(3);  // no direction of noughts alone
    for (uint32_t k = 0; k < 3; ++k) {
      const float sign = (octant >> k & 1) != 0 ? -1.0F : 1.0F;
      const bool nought = k != kept && random.below(8) == 0;
      ray.direction[k] = std::copysign(nought ? 0 : random.between(0.001, 1), sign);
      ray.origin[k] = random.between(0, 1) - random.between(0, 1) * ray.direction[k];
    }
  }
  return rays;
}

std::vector<sobb_ray> rays_of_all_octants(uint32_t count, Random& random) {
  std::vector<sobb_ray> rays;
  for (uint32_t i = 0; i < count; ++i) rays.push_back(octant_rays(random.below(8), 1, random)[0]);
  return rays;
}

// One ray in four is made invalid, in every possible manner, or lies so far away that nothing is
// culled.
void add_strangers(std::vector<sobb_ray>& rays, Random& random) {
  for (sobb_ray& ray : rays) {
    const uint32_t k = random.below(3);
    switch (random.below(24)) {
      case 0:
        ray.origin[k] = std::numeric_limits<float>::quiet_NaN();
        break;
      case 1:
        ray.direction[k] = kInfinity;
        break;
      case 2:
        ray.tmin = -1;
        break;
      case 3:
        ray.tmax = std::numeric_limits<float>::quiet_NaN();
        break;
      case 4:
        for (float& d : ray.direction) d = std::copysign(0.0F, d);
        break;
      case 5:
        ray.origin[k] = 1e30F;
        break;
      default:
        break;
    }
  }
}

class Arrays : public testing::TestWithParam<Case> {
 protected:
  HierarchyHandle build(const Soup& soup) const {
    HierarchyHandle hierarchy = build_soup(soup, options_of(GetParam()));
    return GetParam().k == 0 ? std::move(hierarchy) : with_random_bases(hierarchy, 30);
  }
};

TEST_P(Arrays, AgreeAtEveryLength) {
  const uint64_t seed = 51;
  Random random(seed);
  const Soup soup = random_soup(seed, 600, 0.2);
  const HierarchyHandle hierarchy = build(soup);
  std::vector<sobb_ray> rays = mixed_rays(soup, seed, 2500);
  const std::vector<sobb_ray> more = rays_of_all_octants(2500, random);
  rays.insert(rays.begin() + 1000, more.begin(), more.end());
  add_strangers(rays, random);
  const std::vector<sobb_hit> expected = oracle(soup, rays);
  for (const size_t count : kLengths) {
    expect_hits(hierarchy, rays, count, expected, "seed " + std::to_string(seed));
    if (HasFatalFailure()) return;
  }
}

TEST_P(Arrays, AgreeInEachOctantAlone) {
  const uint64_t seed = 52;
  Random random(seed);
  const Soup soup = random_soup(seed, 600, 0.2);
  const HierarchyHandle hierarchy = build(soup);
  for (uint32_t octant = 0; octant < 8; ++octant) {
    std::vector<sobb_ray> rays = octant_rays(octant, 700, random);
    const std::string what = "seed " + std::to_string(seed) + " octant " + std::to_string(octant);
    expect_hits(hierarchy, rays, rays.size(), oracle(soup, rays), what);
    rays[350] = octant_rays(7 - octant, 1, random)[0];
    expect_hits(hierarchy, rays, rays.size(), oracle(soup, rays), what + " and a stranger");
    if (HasFatalFailure()) return;
  }
}

TEST_P(Arrays, AgreeInSmallAndHostileScenes) {
  const uint64_t seed = 53;
  for (const Soup& soup : {random_soup(seed, 1), random_soup(seed, 6), sliver_soup(seed, 400),
                           closed_box(6), turned_boxes(seed, 30), degenerate_soup(seed, 300),
                           placed(random_soup(seed, 200), 1e-22, 0)}) {
    const HierarchyHandle hierarchy = build(soup);
    const std::vector<sobb_ray> rays = mixed_rays(soup, seed, 1500);
    expect_hits(hierarchy, rays, rays.size(), oracle(soup, rays),
                soup.name + " seed " + std::to_string(seed));
    if (HasFatalFailure()) return;
  }
}

// What strains the bounds that batches, waves and packets cull by.
TEST_P(Arrays, AgreeOnHostileRays) {
  uint64_t seed = 59;
  for (const Soup& soup :
       {random_soup(seed, 400), sliver_soup(seed, 300), degenerate_soup(seed, 300),
        placed(turned_boxes(seed, 20), 1, 1e6), placed(closed_box(5), 0x1p55, 0x1p58)}) {
    const HierarchyHandle hierarchy = build(soup);
    std::vector<std::array<float, 3>> normals;
    for (const Direction& n : hierarchy->view.directions) normals.push_back({n.x, n.y, n.z});
    for (const RayFamily family : kRayFamilies) {
      ++seed;
      const std::vector<sobb_ray> rays = hostile_rays(soup, family, normals, seed, 400);
      expect_hits(hierarchy, rays, rays.size(), oracle(soup, rays),
                  soup.name + ", family " + std::to_string(static_cast<int>(family)) + ", seed " +
                      std::to_string(seed));
      if (HasFatalFailure()) return;
    }
  }
}

TEST_P(Arrays, OfInvalidRaysAloneAreFine) {
  const Soup soup = closed_box(2);
  const HierarchyHandle hierarchy = build(soup);
  const std::vector<sobb_ray> rays(300, {{0, 0, 0}, 0, {0, 0, -0.0F}, kInfinity});
  expect_hits(hierarchy, rays, rays.size(), oracle(soup, rays), "no directions");
}

// What a ray visits on average, as a part of all nodes.
double visited(const HierarchyHandle& hierarchy, const std::vector<sobb_ray>& rays) {
  std::vector<sobb_count> counts(rays.size());
  sobb_trace_options options = trace_options();
  options.counts = counts.data();
  trace(hierarchy, rays, options);
  double nodes = 0;
  for (const sobb_count& count : counts) nodes += count.nodes;
  const sobb_info info = info_of(hierarchy);
  return nodes / static_cast<double>(rays.size() * info.nodes);
}

// Every ray meets every node, so the lists of children are as long as their node's. From the third
// (8-wide) or fourth level (4-wide) on there is no room for them: lists are visited in parts, and
// the parts' children in parts again, down to single rays.
TEST_P(Arrays, AgreeWhereListsFindNoRoom) {
  const uint64_t seed = 54;
  Random random(seed);
  const HierarchyHandle hierarchy = build(identical_soup(12000));
  EXPECT_GE(info_of(hierarchy).depth, GetParam().width == 8 ? 4U : 6U);
  for (const uint32_t octants : {1U, 8U}) {  // 1,024 or 32 rays each
    std::vector<sobb_ray> rays(octants == 1 ? 1024 : 256);
    for (sobb_ray& ray : rays) {  // through the triangle
      const uint32_t octant = random.below(octants);
      const float at[3] = {random.between(0, 0.4), random.between(0, 0.4), 0};
      ray.direction[2] = 1;
      for (int k = 0; k < 2; ++k) ray.direction[k] = random.between(0.01, 0.5);
      for (int k = 0; k < 3; ++k) {
        if ((octant >> k & 1) != 0) ray.direction[k] = -ray.direction[k];
        ray.origin[k] = at[k] - ray.direction[k];
      }
      ray.tmin = 0;
      ray.tmax = kInfinity;
    }
    EXPECT_GE(visited(hierarchy, rays), 0.9) << "all nodes are at one distance";
    const std::vector<sobb_hit> expected = one_by_one(hierarchy, rays);
    EXPECT_EQ(expected[0].primitive, 0U);
    expect_hits(hierarchy, rays, rays.size(), expected,
                "seed " + std::to_string(seed) + " octants " + std::to_string(octants));
    if (HasFatalFailure()) return;
  }
}

// Needles from corner to corner of a cube: a ray meets every box and next to no triangle, so that
// nothing is culled, of any hits neither.
TEST_P(Arrays, AgreeAmongNeedlesThatSpanTheScene) {
  const uint64_t seed = 55;
  Random random(seed);
  Soup soup{"spanning needles", {}, {}};
  for (int t = 0; t < 3000; ++t) {
    float corner[3][3];
    for (int k = 0; k < 3; ++k) {
      const bool flipped = random.below(2) == 0;
      corner[0][k] = (flipped ? 1.0F : 0.0F) + random.between(-1e-3, 1e-3);
      corner[1][k] = (flipped ? 0.0F : 1.0F) + random.between(-1e-3, 1e-3);
      corner[2][k] = corner[1][k] + random.between(-1e-3, 1e-3);
    }
    soup.add(corner[0], corner[1], corner[2]);
  }
  const HierarchyHandle hierarchy = build(soup);
  std::vector<sobb_ray> rays;
  for (const sobb_ray& ray : octant_rays(5, 1000, random)) {
    rays.push_back({{ray.origin[0], ray.origin[1], ray.origin[2]},
                    0,
                    {ray.direction[0], ray.direction[1], ray.direction[2]},
                    kInfinity});
  }
  if (GetParam().k == 0) {
    EXPECT_GE(visited(hierarchy, rays), 0.5);
  }
  expect_hits(hierarchy, rays, rays.size(), one_by_one(hierarchy, rays),
              "seed " + std::to_string(seed));
}

TEST_P(Arrays, AgreeOnAnyThreads) {
  const uint64_t seed = 56;
  Random random(seed);
  const Soup soup = random_soup(seed, 2000);
  const HierarchyHandle hierarchy = build(soup);
  std::vector<sobb_ray> rays = rays_of_all_octants(20000, random);
  add_strangers(rays, random);
  const std::vector<sobb_hit> expected = one_by_one(hierarchy, rays);
  sobb_trace_options options = trace_options(0, 3);
  expect_hits(hierarchy, rays, rays.size(), expected, "threads of TBB", &options);
  ThreadPool pool(3);
  const sobb_scheduler scheduler = pool.callback();
  options = trace_options(0, 0);
  options.scheduler = &scheduler;
  expect_hits(hierarchy, rays, rays.size(), expected, "the caller's threads", &options);
}

TEST_P(Arrays, TakeAndGiveBackTheHostsMemory) {
  const uint64_t seed = 57;
  Random random(seed);
  CountingAllocator counting;
  const sobb_allocator allocator = counting.callback();
  sobb_build_options options = options_of(GetParam());
  options.allocator = &allocator;
  const HierarchyHandle hierarchy = build_soup(random_soup(seed, 300), options);
  const size_t kept = counting.blocks();
  const uint64_t peak = info_of(hierarchy).peak_bytes;
  const std::vector<sobb_ray> rays = rays_of_all_octants(5000, random);
  const auto allocations = [&](size_t count, const sobb_trace_options& how) {
    const uint64_t before = counting.calls();
    trace(hierarchy, {rays.begin(), rays.begin() + static_cast<ptrdiff_t>(count)}, how);
    EXPECT_EQ(counting.blocks(), kept) << "given back by the end of the call";
    return counting.calls() - before;
  };
  EXPECT_EQ(allocations(1, trace_options()), 0U);
  EXPECT_EQ(allocations(255, trace_options()), 0U);
  EXPECT_EQ(allocations(256, trace_options()), 1U);
  EXPECT_EQ(allocations(5000, trace_options()), 1U) << "one block a thread";
  EXPECT_LE(allocations(5000, trace_options(0, 2)), 2U);
  EXPECT_EQ(allocations(255, trace_options(SOBB_TRACE_COHERENT)), 0U);
  EXPECT_EQ(allocations(5000, trace_options(SOBB_TRACE_COHERENT)), 1U);
  std::vector<sobb_count> counts(rays.size());
  sobb_trace_options counted = trace_options();
  counted.counts = counts.data();
  EXPECT_EQ(allocations(5000, counted), 0U);
  EXPECT_EQ(info_of(hierarchy).peak_bytes, peak) << "that is the build's";
}

TEST_P(Arrays, WithoutMemoryGoRayByRay) {
  const uint64_t seed = 58;
  Random random(seed);
  CountingAllocator counting;
  const sobb_allocator allocator = counting.callback();
  sobb_build_options options = options_of(GetParam());
  options.allocator = &allocator;
  const Soup soup = random_soup(seed, 300);
  const HierarchyHandle hierarchy = build_soup(soup, options);
  const size_t kept = counting.blocks();
  std::vector<sobb_ray> rays = rays_of_all_octants(5000, random);
  add_strangers(rays, random);
  const std::vector<sobb_hit> expected = oracle(soup, rays);
  for (const uint64_t refusals : {uint64_t{1}, uint64_t{2}, UINT64_MAX}) {
    for (const uint32_t threads : {1U, 3U}) {
      counting.refuse_next(refusals);
      const sobb_trace_options how = trace_options(0, threads);
      expect_hits(hierarchy, rays, rays.size(), expected,
                  std::to_string(refusals) + " refusals, seed " + std::to_string(seed), &how);
      counting.refuse_next(0);
      EXPECT_EQ(counting.blocks(), kept);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Volumes, Arrays,
                         testing::Values(Case{0, 4}, Case{0, 8}, Case{32, 4}, Case{32, 8},
                                         Case{64, 4}, Case{64, 8}),
                         [](const testing::TestParamInfo<Case>& info) {
                           const Case& which = info.param;
                           return (which.k == 0 ? "aabb" : "sobb" + std::to_string(which.k)) + "_" +
                                  std::to_string(which.width) + "wide";
                         });

}  // namespace
}  // namespace sobb::test
