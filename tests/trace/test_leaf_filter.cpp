// SPDX-License-Identifier: Apache-2.0
// The float test in front of the deciding one (leaf_filter-inl.h), where its error bounds are
// strained: long lists of rays before few triangles, so that each ray takes it, aimed within ulps
// of edges, corners and planes, from near and far, with intervals that begin or end at the hit.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "capi/handles.h"
#include "hierarchy.h"
#include "support/scratch.h"
#include "support/soups.h"
#include "support/supported_isas.h"
#include "trace/trace.h"

namespace sobb::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Up to four ulps away.
float nudged(float x, Random& random) {
  for (uint32_t steps = random.below(5); steps != 0; --steps) {
    x = std::nextafter(x, random.below(2) == 0 ? kInfinity : -kInfinity);
  }
  return x;
}

// Weights of a point of a triangle: inside, on an edge, or a corner.
std::array<double, 3> weights(Random& random) {
  std::array<double, 3> w = {random.uniform(), random.uniform(), random.uniform()};
  const uint32_t noughts = random.below(3);
  for (uint32_t i = 0; i < noughts; ++i) w[(i + random.below(2)) % 3] = 0;
  const double sum = w[0] + w[1] + w[2];
  if (sum == 0) return {1, 0, 0};
  for (double& weight : w) weight /= sum;
  return w;
}

// From off a triangle, by much or by ulps, and perhaps within its plane, towards a point of it or
// next to it.
sobb_ray strained_ray(const Soup& soup, Random& random) {
  const uint64_t triangle = random.below(static_cast<uint32_t>(soup.indices.size() / 3));
  const auto point = [&](float(&to)[3]) {
    const std::array<double, 3> w = weights(random);
    for (int k = 0; k < 3; ++k) {
      double at = 0;
      for (int i = 0; i < 3; ++i) at += w[i] * soup.corner(triangle, i)[k];
      to[k] = static_cast<float>(at);
    }
  };
  float target[3];
  float other[3];
  point(target);
  point(other);
  double size = 0;
  for (int k = 0; k < 3; ++k) {
    size += std::abs(double{soup.corner(triangle, 1)[k]} - soup.corner(triangle, 0)[k]);
  }
  sobb_ray ray = {{0, 0, 0}, 0, {0, 0, 0}, kInfinity};
  const double away = size * std::pow(10.0, random.between(-6, 3));
  const bool in_plane = random.below(8) == 0;
  bool still = true;
  for (int k = 0; k < 3; ++k) {
    const double step = in_plane ? double{target[k]} - other[k] : away * random.between(-1, 1);
    ray.origin[k] = static_cast<float>(target[k] - step);
    // Now and then the other way, past the triangle.
    ray.direction[k] = nudged(static_cast<float>(random.below(16) == 0 ? -step : step), random);
    still &= ray.direction[k] == 0;
  }
  if (still) ray.direction[random.below(3)] = 1;
  if (random.below(4) == 0) {
    for (float& at : ray.origin) at = nudged(at, random);
  }
  return ray;
}

// Intervals that begin or end at the ray's hit, or next to it.
void bound_at_hits(std::vector<sobb_ray>& rays, const std::vector<sobb_hit>& hits, Random& random) {
  for (size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].primitive >= SOBB_INVALID || random.below(2) == 0) continue;
    const float at = random.below(2) == 0 ? hits[i].t : std::abs(nudged(hits[i].t, random));
    (random.below(2) == 0 ? rays[i].tmin : rays[i].tmax) = at;
  }
}

void expect_batches_agree(sobb_isa isa, const HierarchyHandle& hierarchy,
                          const std::vector<sobb_ray>& rays,
                          const std::vector<sobb_hit>& expected) {
  SCOPED_TRACE("isa " + std::to_string(isa));
  const TraceKernels& kernels = trace_kernels(isa);
  const Scratch scratch(kernels.scratch_bytes);
  std::vector<sobb_hit> hits(rays.size());
  std::vector<uint8_t> occluded(rays.size());
  const Tracer& tracer = hierarchy->tracer;
  kernels.intersect_array[kBatchMode](tracer, rays.data(), rays.size(), hits.data(), scratch.get());
  kernels.occluded_array[kBatchMode](tracer, rays.data(), rays.size(), occluded.data(),
                                     scratch.get());
  for (size_t i = 0; i < rays.size(); ++i) {
    ASSERT_TRUE(same(hits[i], expected[i]))
        << "ray " << i << " hits " << hits[i].primitive << " at " << hits[i].t << ", not "
        << expected[i].primitive << " at " << expected[i].t;
    ASSERT_EQ(occluded[i], expected[i].primitive < SOBB_INVALID ? SOBB_OCCLUDED : SOBB_FREE)
        << "ray " << i;
  }
}

TEST(LeafFilter, TellsWhatTheDecidingTestWouldSay) {
  uint64_t seed = 1000;
  uint64_t hit = 0;
  uint64_t rays_in_all = 0;
  for (uint32_t triangles = 1; triangles <= 7; triangles += 2) {
    for (const double scale : {1e-25, 1e-6, 1.0, 0x1p20, 0x1p42}) {
      for (const double offset : {0.0, 30.0, 1e5}) {
        ++seed;
        for (const Soup& shape : {random_soup(seed, triangles, 1), sliver_soup(seed, triangles),
                                  degenerate_soup(seed, triangles)}) {
          const Soup soup = placed(shape, scale, offset * scale);
          SCOPED_TRACE(soup.name + " of " + std::to_string(triangles) + ", seed " +
                       std::to_string(seed) + ", scale " + std::to_string(scale) + ", offset " +
                       std::to_string(offset));
          const HierarchyHandle hierarchy = build_soup(soup);
          Random random(seed);
          std::vector<sobb_ray> rays(kBatchRays);
          rays_in_all += rays.size();
          for (sobb_ray& ray : rays) ray = strained_ray(soup, random);
          bound_at_hits(rays, oracle(soup, rays), random);
          const std::vector<sobb_hit> expected = oracle(soup, rays);
          for (const sobb_hit& each : expected) hit += each.primitive < SOBB_INVALID ? 1 : 0;
          for (const sobb_isa isa : supported_isas()) {
            expect_batches_agree(isa, hierarchy, rays, expected);
            if (HasFatalFailure()) return;
          }
        }
      }
    }
  }
  EXPECT_GT(hit, rays_in_all / 4) << "the rays are to hit";
  EXPECT_LT(hit, rays_in_all * 3 / 4) << "and to miss";
}

}  // namespace
}  // namespace sobb::test
