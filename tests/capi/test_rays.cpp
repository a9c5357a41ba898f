// SPDX-License-Identifier: Apache-2.0
// What the tracing calls promise of rays: which are invalid, intervals, lengths, masks, alignment,
// counts, the caller's floating-point control.
#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <cmath>
#include <functional>
#include <limits>

#include "capi/handles.h"

namespace sobb::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr uint32_t kVolumes[] = {SOBB_VOLUME_AABB, SOBB_VOLUME_SOBB};

// Down onto the middle of the unit cube's top, which it hits at t = 1.
constexpr sobb_ray kDown = {{0.4F, 0.3F, 2}, 0, {0, 0, -1}, kInfinity};

sobb_ray with(const std::function<void(sobb_ray&)>& change) {
  sobb_ray ray = kDown;
  change(ray);
  return ray;
}

// Every call and mode on an array.
class Rays : public testing::TestWithParam<uint32_t> {
 protected:
  HierarchyHandle box_ = build_soup(closed_box(3), build_options(GetParam()));

  // Traces all ways, expects them to agree, and returns the hits.
  std::vector<sobb_hit> trace_all(const std::vector<sobb_ray>& rays, uint64_t invalid) const {
    std::vector<sobb_hit> expected = oracle(rays);
    for (const uint32_t flags : {0U, static_cast<uint32_t>(SOBB_TRACE_COHERENT)}) {
      uint64_t seen = 12345;
      sobb_trace_options options = trace_options(flags);
      options.invalid_rays = &seen;
      EXPECT_TRUE(same(trace(box_, rays, options), expected)) << "flags " << flags;
      EXPECT_EQ(seen, invalid);
      seen = 12345;
      std::vector<uint8_t> occluded(rays.size(), 77);
      EXPECT_EQ(sobb_occluded(box_.get(), rays.data(), rays.size(), occluded.data(), &options),
                SOBB_OK);
      EXPECT_EQ(seen, invalid);
      for (size_t i = 0; i < rays.size(); ++i) {
        EXPECT_EQ(occluded[i], occluded_of(expected[i])) << "ray " << i << " flags " << flags;
      }
    }
    for (size_t i = 0; i < rays.size(); ++i) {
      sobb_hit hit;
      EXPECT_EQ(sobb_intersect1(box_.get(), &rays[i], &hit), SOBB_OK);
      EXPECT_TRUE(same(hit, expected[i])) << "ray " << i;
      uint8_t occluded = 77;
      EXPECT_EQ(sobb_occluded1(box_.get(), &rays[i], &occluded), SOBB_OK);
      EXPECT_EQ(occluded, occluded_of(expected[i])) << "ray " << i;
    }
    return expected;
  }

  sobb_hit hit_of(const sobb_ray& ray) const { return trace_all({ray}, 0)[0]; }

 private:
  static std::vector<sobb_hit> oracle(const std::vector<sobb_ray>& rays) {
    const Soup soup = closed_box(3);
    const sobb_triangles triangles = soup.view();
    std::vector<sobb_hit> hits(rays.size());
    EXPECT_EQ(sobb_brute_force(&triangles, rays.data(), rays.size(), hits.data(), nullptr),
              SOBB_OK);
    return hits;
  }

  static uint8_t occluded_of(const sobb_hit& hit) {
    if (hit.primitive == SOBB_INVALID) return SOBB_OCCLUDED_INVALID;
    return hit.primitive == SOBB_MISS ? SOBB_FREE : SOBB_OCCLUDED;
  }
};

TEST_P(Rays, InvalidOnesAreMarkedAndTheOthersTraced) {
  std::vector<sobb_ray> invalid;
  for (int k = 0; k < 3; ++k) {
    for (const float bad : {kNan, kInfinity, -kInfinity}) {
      invalid.push_back(with([&](auto& ray) { ray.origin[k] = bad; }));
      invalid.push_back(with([&](auto& ray) { ray.direction[k] = bad; }));
    }
  }
  invalid.push_back(with([](auto& ray) { ray.direction[2] = 0; }));
  invalid.push_back(with([](auto& ray) { ray.direction[2] = -0.0F; }));
  invalid.push_back(with([](auto& ray) { ray.tmin = kNan; }));
  invalid.push_back(with([](auto& ray) { ray.tmin = -1; }));
  invalid.push_back(with([](auto& ray) { ray.tmin = -0x1p-149F; }));
  invalid.push_back(with([](auto& ray) { ray.tmin = -kInfinity; }));
  invalid.push_back(with([](auto& ray) { ray.tmax = kNan; }));
  std::vector<sobb_ray> rays;
  for (const sobb_ray& ray : invalid) {
    rays.push_back(ray);
    rays.push_back(kDown);
  }
  const std::vector<sobb_hit> hits = trace_all(rays, invalid.size());
  for (size_t i = 0; i < rays.size(); ++i) {
    const sobb_hit& hit = hits[i];
    if (i % 2 == 1) {
      EXPECT_EQ(hit.t, 1) << "ray " << i;
      EXPECT_EQ(hit.geometry, 0u);
      EXPECT_EQ(hit.instance, SOBB_MISS);
      continue;
    }
    EXPECT_EQ(hit.primitive, SOBB_INVALID) << "ray " << i;
    EXPECT_EQ(hit.t, kInfinity);
    EXPECT_EQ(hit.u, 0);
    EXPECT_EQ(hit.v, 0);
    EXPECT_EQ(hit.geometry, SOBB_MISS);
    EXPECT_EQ(hit.instance, SOBB_MISS);
  }
}

TEST_P(Rays, IntervalIsClosed) {
  const auto between = [&](float tmin, float tmax) {
    return hit_of(with([&](auto& ray) {
             ray.tmin = tmin;
             ray.tmax = tmax;
           }))
        .t;
  };
  const float after = std::nextafter(1.0F, 2.0F);
  const float before = std::nextafter(1.0F, 0.0F);
  EXPECT_EQ(between(0, kInfinity), 1);
  EXPECT_EQ(between(-0.0F, kInfinity), 1);
  EXPECT_EQ(between(1, 1), 1);
  EXPECT_EQ(between(0, 1), 1);
  EXPECT_EQ(between(1, kInfinity), 1);
  EXPECT_EQ(between(0, before), kInfinity);
  EXPECT_EQ(between(after, kInfinity), 2) << "the bottom";
  EXPECT_EQ(between(2, 2), 2);
  EXPECT_EQ(between(after, std::nextafter(2.0F, 0.0F)), kInfinity);
  EXPECT_EQ(between(std::nextafter(2.0F, 3.0F), kInfinity), kInfinity);
  EXPECT_EQ(between(2, 1), kInfinity) << "tmin > tmax";
  EXPECT_EQ(between(0, 0), kInfinity);
  EXPECT_EQ(between(0, -1), kInfinity);
  EXPECT_EQ(between(0, -kInfinity), kInfinity);
  EXPECT_EQ(between(0, std::numeric_limits<float>::max()), 1);
  EXPECT_EQ(between(kInfinity, kInfinity), kInfinity);
}

TEST_P(Rays, StartingOnASurfaceHitsItAtNought) {
  const sobb_hit hit = hit_of(with([](auto& ray) { ray.origin[2] = 1; }));
  EXPECT_EQ(hit.t, 0);
}

TEST_P(Rays, DirectionsHaveAnyLength) {
  const sobb_hit expected = hit_of(kDown);
  for (int exponent = -125; exponent <= 127; exponent += 4) {
    const float length = std::ldexp(1.0F, exponent);
    const sobb_hit hit = hit_of(with([&](auto& ray) { ray.direction[2] = -length; }));
    EXPECT_EQ(hit.primitive, expected.primitive) << "2^" << exponent;
    EXPECT_EQ(hit.t, 1 / length);
    EXPECT_EQ(hit.u, expected.u);
  }
  // t beyond the largest float is none.
  EXPECT_EQ(hit_of(with([&](auto& ray) { ray.direction[2] = -0x1p-140F; })).t, kInfinity);
}

TEST_P(Rays, TrianglesHaveTwoSides) {
  EXPECT_EQ(hit_of(with([](auto& ray) { ray.origin[2] = 0.5F; })).t, 0.5F);
  EXPECT_EQ(hit_of(with([](auto& ray) {
              ray.origin[2] = 0.5F;
              ray.direction[2] = 1;
            })).t,
            0.5F);
}

TEST_P(Rays, PacketsLeaveWhatIsNotAskedForAlone) {
  const std::vector<sobb_ray> rays = mixed_rays(closed_box(3), 21, 16);
  const std::vector<sobb_hit> expected = trace_all(rays, 0);
  sobb_hit untouched;
  std::memset(&untouched, 0xCD, sizeof untouched);
  for (const uint32_t mask : {0U, 1U, 0x8000U, 0x5555U, 0xFFFFU, 0x00F0U}) {
    std::vector<sobb_hit> hits(16, untouched);
    std::vector<uint8_t> occluded(16, 0xCD);
    ASSERT_EQ(sobb_intersect_packet(box_.get(), rays.data(), mask, hits.data()), SOBB_OK);
    ASSERT_EQ(sobb_occluded_packet(box_.get(), rays.data(), mask, occluded.data()), SOBB_OK);
    for (uint32_t i = 0; i < 16; ++i) {
      const bool asked = (mask >> i & 1) != 0;
      EXPECT_TRUE(same(hits[i], asked ? expected[i] : untouched))
          << "mask " << mask << " ray " << i;
      EXPECT_EQ(occluded[i], asked ? expected[i].primitive != SOBB_MISS : 0xCD);
    }
  }
  // No more rays than the highest bit asks for are read (seen by a sanitizer).
  const std::vector<sobb_ray> three(rays.begin(), rays.begin() + 3);
  std::vector<sobb_hit> hits(3);
  ASSERT_EQ(sobb_intersect_packet(box_.get(), three.data(), 5, hits.data()), SOBB_OK);
  EXPECT_TRUE(same(hits[2], expected[2]));
}

TEST_P(Rays, BadArgumentsAreRefused) {
  sobb_ray rays[16] = {};
  sobb_hit hits[16];
  uint8_t occluded[16];
  sobb_hierarchy* box = box_.get();
  EXPECT_EQ(sobb_intersect_packet(box, rays, 0x10000, hits), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(sobb_last_error(), "mask is 0x10000, a packet has 16 rays");
  EXPECT_EQ(sobb_occluded_packet(box, rays, 0x80000001, occluded), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_intersect_packet(nullptr, rays, 1, hits), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_intersect_packet(box, nullptr, 1, hits), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_occluded_packet(box, rays, 1, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_intersect(nullptr, rays, 1, hits, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(sobb_last_error(), "hierarchy is NULL");
  EXPECT_EQ(sobb_intersect(box, nullptr, 1, hits, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_intersect(box, rays, 1, nullptr, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_occluded(box, rays, 1, nullptr, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_intersect1(box, nullptr, hits), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_occluded1(box, rays, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_brute_force(nullptr, rays, 1, hits, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
  sobb_trace_options options = trace_options(2);
  EXPECT_EQ(sobb_intersect(box, rays, 1, hits, &options), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(sobb_last_error(), "trace options: flags are 0x2");
  options = trace_options();
  options.isa = sobb_isa_count() + 1;
  EXPECT_EQ(sobb_intersect(box, rays, 1, hits, &options), SOBB_ERROR_INVALID_ARGUMENT);
  options = trace_options();
  options.struct_size = 2;
  EXPECT_EQ(sobb_intersect(box, rays, 1, hits, &options), SOBB_ERROR_INVALID_ARGUMENT);
}

TEST_P(Rays, NoneAreFineWithoutArrays) {
  uint64_t invalid = 5;
  sobb_trace_options options = trace_options(0, 3);
  options.invalid_rays = &invalid;
  EXPECT_EQ(sobb_intersect(box_.get(), nullptr, 0, nullptr, &options), SOBB_OK);
  EXPECT_EQ(invalid, 0u);
  EXPECT_EQ(sobb_occluded(box_.get(), nullptr, 0, nullptr, nullptr), SOBB_OK);
  const Soup soup = closed_box(1);
  const sobb_triangles triangles = soup.view();
  EXPECT_EQ(sobb_brute_force(&triangles, nullptr, 0, nullptr, nullptr), SOBB_OK);
}

TEST_P(Rays, ArraysNeedNoMoreThanAFloatsAlignment) {
  const std::vector<sobb_ray> rays = mixed_rays(closed_box(3), 22, 100);
  const std::vector<sobb_hit> expected = trace_all(rays, 0);
  std::vector<float> ray_floats(rays.size() * 8 + 8);
  std::vector<float> hit_floats(rays.size() * 6 + 8);
  for (size_t offset = 0; offset < 8; ++offset) {
    std::memcpy(&ray_floats[offset], rays.data(), rays.size() * sizeof rays[0]);
    auto* odd_rays = reinterpret_cast<const sobb_ray*>(&ray_floats[offset]);
    auto* odd_hits = reinterpret_cast<sobb_hit*>(&hit_floats[offset]);
    for (const uint32_t flags : {0U, static_cast<uint32_t>(SOBB_TRACE_COHERENT)}) {
      const sobb_trace_options options = trace_options(flags);
      ASSERT_EQ(sobb_intersect(box_.get(), odd_rays, rays.size(), odd_hits, &options), SOBB_OK);
      EXPECT_EQ(std::memcmp(odd_hits, expected.data(), rays.size() * sizeof expected[0]), 0);
    }
  }
}

TEST_P(Rays, CountsSayWhatWasTested) {
  const std::vector<sobb_ray> rays = {kDown, with([](auto& ray) { ray.origin[0] = 5; }),
                                      with([](auto& ray) { ray.tmax = kNan; })};
  std::vector<sobb_count> counts(rays.size(), {99, 99, 99, 99});
  sobb_trace_options options = trace_options(SOBB_TRACE_COHERENT);  // counts ask for single rays
  options.counts = counts.data();
  EXPECT_TRUE(same(trace(box_, rays, options), trace(box_, rays)));
  EXPECT_GE(counts[0].nodes, 1u);
  EXPECT_GE(counts[0].volumes, counts[0].nodes);
  EXPECT_LE(counts[0].volumes, counts[0].nodes * 8);
  EXPECT_GE(counts[0].blocks, 1u);
  EXPECT_GE(counts[0].triangles, counts[0].blocks);
  EXPECT_LE(counts[0].triangles, counts[0].blocks * 4);
  EXPECT_EQ(counts[1].nodes, 1u) << "beside the box: the root alone";
  EXPECT_EQ(counts[1].blocks, 0u);
  EXPECT_EQ(counts[2].nodes, 0u) << "an invalid ray";
  std::vector<uint8_t> occluded(rays.size());
  ASSERT_EQ(sobb_occluded(box_.get(), rays.data(), rays.size(), occluded.data(), &options),
            SOBB_OK);
  EXPECT_GE(counts[0].blocks, 1u);
}

TEST_P(Rays, CallersFloatingPointControlIsKeptAndIgnored) {
  const Soup soup = placed(random_soup(23, 400, 0.3), 1e-38, 0);  // denormals count
  const sobb_triangles triangles = soup.view();
  const HierarchyHandle hierarchy = build_soup(soup, build_options(GetParam()));
  const std::vector<sobb_ray> rays = mixed_rays(soup, 24, 2000);
  const std::vector<sobb_hit> expected = trace(hierarchy, rays);
  std::vector<sobb_hit> oracle(rays.size());
  for (const unsigned odd : {0x1F80U | 0x8040U, 0x1F80U | _MM_ROUND_UP, 0x1F80U | _MM_ROUND_DOWN,
                             0x1F80U | _MM_ROUND_TOWARD_ZERO | 0x8040U}) {
    for (const uint32_t flags : {0U, static_cast<uint32_t>(SOBB_TRACE_COHERENT)}) {
      for (const uint32_t threads : {1U, 3U}) {
        const sobb_trace_options options = trace_options(flags, threads);
        const unsigned found = _mm_getcsr();
        _mm_setcsr(odd);
        const std::vector<sobb_hit> hits = trace(hierarchy, rays, options);
        sobb_hit one;
        const sobb_status first = sobb_intersect1(hierarchy.get(), rays.data(), &one);
        const sobb_status second =
            sobb_brute_force(&triangles, rays.data(), rays.size(), oracle.data(), &options);
        const unsigned after = _mm_getcsr();
        _mm_setcsr(found);
        EXPECT_EQ(first, SOBB_OK);
        EXPECT_EQ(second, SOBB_OK);
        EXPECT_EQ(after & ~0x3FU, odd) << "flags but those of exceptions";
        EXPECT_TRUE(same(hits, expected));
        EXPECT_TRUE(same(one, expected[0]));
        EXPECT_TRUE(same(oracle, expected));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Volumes, Rays, testing::ValuesIn(kVolumes),
                         [](const testing::TestParamInfo<uint32_t>& info) {
                           return info.param == SOBB_VOLUME_AABB ? "aabb" : "sobb";
                         });

}  // namespace
}  // namespace sobb::test
