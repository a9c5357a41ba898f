// SPDX-License-Identifier: Apache-2.0
// Narrow bundles of rays from one eye, or to one light, as packets trace them together: the same
// bits as ray by ray, whatever they look along, and whatever stands among them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "capi/handles.h"
#include "capi/random_bases.h"
#include "support/soups.h"
#include "support/supported_isas.h"

namespace sobb::test {
namespace {

struct Eye {
  std::string name;
  float origin[3];
  float along[3];  // the middle of the bundles
};

// Along an axis, where directions change sign; along diagonals, where the largest component does;
// within the scene, on its faces and far from it.
const Eye kEyes[] = {
    {"above", {0.5F, 0.5F, 4}, {0, 0, -1}},        {"below", {0.25F, 0.75F, -3}, {0, 0, 1}},
    {"left", {-5, 0.5F, 0.5F}, {1, 0, 0}},         {"right", {6, 0.25F, 0.5F}, {-1, 0, 0}},
    {"diagonal", {-2, -2, 0.5F}, {1, 1, 0}},       {"corner", {-3, -3, -3}, {1, 1, 1}},
    {"opposite", {4, 4, -3}, {-1, -1, 1}},         {"inside", {0.5F, 0.5F, 0.5F}, {-1, 0.3F, 0.2F}},
    {"on a face", {0.5F, 0.5F, 0}, {0, 0.01F, 1}}, {"far", {3e4F, 2e4F, -1e4F}, {-3, -2, 1}},
    {"too far", {1e19F, 0, 0}, {-1, 0, 0}},
};

// Bundles of 64, their rays in a square of `width`, some of them turned to a corner of a triangle.
std::vector<sobb_ray> bundles(const Soup& soup, const Eye& eye, double width, uint64_t seed) {
  Random random(seed);
  std::vector<sobb_ray> rays;
  for (int bundle = 0; bundle < 12; ++bundle) {
    float middle[3];
    for (int k = 0; k < 3; ++k) middle[k] = eye.along[k] + random.between(-0.15, 0.15);
    if (bundle < 4) std::copy_n(eye.along, 3, middle);
    const float length = std::ldexp(1.0F, static_cast<int>(random.below(9)) - 4);
    for (int i = 0; i < 64; ++i) {
      sobb_ray ray = {{eye.origin[0], eye.origin[1], eye.origin[2]},
                      0,
                      {},
                      std::numeric_limits<float>::infinity()};
      const bool aimed = bundle % 3 == 2 && i % 4 == 0;
      const auto triangle = random.below(static_cast<uint32_t>(soup.indices.size() / 3));
      for (int k = 0; k < 3; ++k) {
        ray.direction[k] = aimed ? soup.corner(triangle, i % 3)[k] - eye.origin[k]
                                 : length * (middle[k] + random.between(-width, width));
      }
      rays.push_back(ray);
    }
  }
  return rays;
}

struct Light {
  std::string name;
  float at[3];
};

// Within a scene, on its faces and corners, outside and far away.
const Light kLights[] = {
    {"inside", {0.5F, 0.45F, 0.55F}}, {"on a face", {0.5F, 0.5F, 0}},
    {"at a corner", {1, 1, 1}},       {"above", {0.3F, 0.6F, 1.001F}},
    {"outside", {-2, 3, 5}},          {"on an axis", {0.5F, 0.5F, 4}},
    {"far", {3e4F, -2e4F, 1e4F}},     {"too far", {0, 1e19F, 0}},
};

// Rays from patches of `width` to a light, 64 each, a few from elsewhere. Patches lie on triangles,
// in the air and on the scene's box; some begin at corners of triangles. Every other patch has a
// light of its own: a corner.
std::vector<sobb_ray> shadow_bundles(const Soup& soup, const Light& light, double width,
                                     uint64_t seed) {
  Random random(seed);
  std::vector<sobb_ray> rays;
  const auto triangles = static_cast<uint32_t>(soup.indices.size() / 3);
  const float* const corners = soup.vertices.data();
  for (int bundle = 0; bundle < 12; ++bundle) {
    const float* to = bundle % 2 == 0 ? light.at : soup.corner(random.below(triangles), 0);
    const uint32_t on = random.below(triangles);
    float middle[3];
    for (float& x : middle) x = random.between(0, 1);
    if (bundle % 3 == 0) std::copy_n(soup.corner(on, 1), 3, middle);
    if (bundle % 3 == 1) middle[random.below(3)] = static_cast<float>(random.below(2));
    const double length = bundle < 6 ? 1 : std::ldexp(0.6 + random.uniform(), bundle - 9);
    for (uint32_t i = 0; i < 64; ++i) {
      sobb_ray ray = {{}, 0, {}, static_cast<float>(1 / length)};
      const float* corner = corners + 3 * random.below(3 * triangles);
      for (int k = 0; k < 3; ++k) {
        ray.origin[k] = middle[k] + random.between(-width, width);
        if (bundle > 7 && i % 9 == 0) ray.origin[k] = corner[k];
        ray.direction[k] = static_cast<float>(length * (double{to[k]} - double{ray.origin[k]}));
      }
      rays.push_back(ray);
    }
  }
  return rays;
}

class Packets : public testing::TestWithParam<uint32_t> {
 protected:
  HierarchyHandle build(const Soup& soup, uint32_t quality = 0, uint32_t width = 0) {
    sobb_build_options options = build_options(GetParam(), quality);
    options.width = width;
    HierarchyHandle hierarchy = build_soup(soup, options);
    return GetParam() == SOBB_VOLUME_AABB ? std::move(hierarchy) : with_random_bases(hierarchy, 30);
  }

  // Arrays with the coherent flag, packets and occlusion against rays one by one.
  void expect_agreement(const HierarchyHandle& hierarchy, const std::vector<sobb_ray>& rays,
                        const std::string& what) {
    const std::vector<sobb_hit> expected = trace(hierarchy, rays);
    for (const sobb_isa isa : supported_isas()) {
      sobb_trace_options options = trace_options(SOBB_TRACE_COHERENT);
      options.isa = isa;
      const std::vector<sobb_hit> hits = trace(hierarchy, rays, options);
      std::vector<uint8_t> occluded(rays.size());
      ASSERT_EQ(sobb_occluded(hierarchy.get(), rays.data(), rays.size(), occluded.data(), &options),
                SOBB_OK);
      for (size_t i = 0; i < rays.size(); ++i) {
        ASSERT_TRUE(same(hits[i], expected[i])) << what << ", isa " << isa << ", ray " << i;
        ASSERT_EQ(occluded[i], occlusion(expected[i])) << what << ", isa " << isa << ", ray " << i;
      }
    }
    sobb_hit hits[16];
    for (size_t i = 0; i + 16 <= rays.size(); i += 16) {
      ASSERT_EQ(sobb_intersect_packet(hierarchy.get(), &rays[i], 0xFFFF, hits), SOBB_OK);
      for (size_t j = 0; j < 16; ++j) {
        ASSERT_TRUE(same(hits[j], expected[i + j])) << what << ", packet, ray " << i + j;
      }
      uint8_t occluded[16];
      ASSERT_EQ(sobb_occluded_packet(hierarchy.get(), &rays[i], 0xFFFF, occluded), SOBB_OK);
      for (size_t j = 0; j < 16; ++j) {
        ASSERT_EQ(occluded[j], occlusion(expected[i + j])) << what << ", packet, ray " << i + j;
      }
    }
  }

  // A scene before every eye, in narrow and wide bundles, the rays changed by `change`.
  void check(const Soup& soup, uint64_t seed,
             const std::function<void(std::vector<sobb_ray>&, Random&)>& change) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    for (const uint32_t width : {4U, 8U}) {
      const HierarchyHandle hierarchy = build(soup, SOBB_QUALITY_HIGH, width);
      for (const Eye& eye : kEyes) {
        for (const double spread : {1e-5, 1e-3, 4e-3, 0.02, 0.2}) {
          std::vector<sobb_ray> rays = bundles(soup, eye, spread, random.bits());
          change(rays, random);
          expect_agreement(hierarchy, rays, soup.name + " from " + eye.name);
          if (HasFatalFailure()) return;
        }
      }
    }
  }

  // Rays to every light keep that promise, too.
  void check_shadows(const Soup& soup, uint64_t seed,
                     const std::function<void(std::vector<sobb_ray>&, Random&)>& change) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    for (const uint32_t width : {4U, 8U}) {
      const HierarchyHandle hierarchy = build(soup, SOBB_QUALITY_HIGH, width);
      for (const Light& light : kLights) {
        for (const double patch : {1e-5, 1e-3, 0.01, 0.1}) {
          std::vector<sobb_ray> rays = shadow_bundles(soup, light, patch, random.bits());
          change(rays, random);
          expect_agreement(hierarchy, rays, soup.name + " to a light " + light.name);
          if (HasFatalFailure()) return;
        }
      }
    }
  }

 private:
  static uint8_t occlusion(const sobb_hit& hit) {
    if (hit.primitive == SOBB_INVALID) return SOBB_OCCLUDED_INVALID;
    return hit.primitive == SOBB_MISS ? SOBB_FREE : SOBB_OCCLUDED;
  }
};

void nothing(std::vector<sobb_ray>& /*rays*/, Random& /*random*/) {}

TEST_P(Packets, AgreeInSoups) { check(random_soup(31, 900, 0.2), 1, nothing); }
TEST_P(Packets, AgreeInDustSmallerThanAPixel) { check(random_soup(32, 3000, 2e-4), 2, nothing); }
TEST_P(Packets, AgreeInSlivers) { check(sliver_soup(33, 600), 3, nothing); }
TEST_P(Packets, AgreeOnSharedEdges) { check(closed_box(6), 4, nothing); }
TEST_P(Packets, AgreeInTurnedBoxes) { check(turned_boxes(34, 40), 5, nothing); }

TEST_P(Packets, AgreeForAnyIntervals) {
  check(random_soup(35, 900, 0.2), 6, [](std::vector<sobb_ray>& rays, Random& random) {
    for (sobb_ray& ray : rays) {
      if (random.below(2) == 0) ray.tmin = random.between(0, 6);
      if (random.below(2) == 0) ray.tmax = random.between(-0.5, 12);
    }
  });
}

TEST_P(Packets, AgreeWithStrangersAmongThem) {
  check(random_soup(36, 900, 0.2), 7, [](std::vector<sobb_ray>& rays, Random& random) {
    for (sobb_ray& ray : rays) {
      switch (random.below(12)) {
        case 0:  // invalid
          ray.direction[random.below(3)] = std::numeric_limits<float>::quiet_NaN();
          break;
        case 1:
          ray.tmin = -1;
          break;
        case 2:  // from elsewhere
          ray.origin[random.below(3)] += 0.25F;
          break;
        case 3:  // the other way
          for (float& d : ray.direction) d = -d;
          break;
        case 4:  // along another axis
          std::swap(ray.direction[0], ray.direction[2]);
          break;
        default:
          break;
      }
    }
  });
}

TEST_P(Packets, AgreeOnShadowsInSoups) { check_shadows(random_soup(41, 900, 0.2), 11, nothing); }
TEST_P(Packets, AgreeOnShadowsInDust) { check_shadows(random_soup(42, 3000, 2e-3), 12, nothing); }
TEST_P(Packets, AgreeOnShadowsInSlivers) { check_shadows(sliver_soup(43, 600), 13, nothing); }
TEST_P(Packets, AgreeOnShadowsInAClosedBox) { check_shadows(closed_box(6), 14, nothing); }
TEST_P(Packets, AgreeOnShadowsInTurnedBoxes) { check_shadows(turned_boxes(44, 40), 15, nothing); }

TEST_P(Packets, AgreeOnShadowsOfAnyInterval) {
  check_shadows(random_soup(45, 900, 0.2), 16, [](std::vector<sobb_ray>& rays, Random& random) {
    for (sobb_ray& ray : rays) {
      if (random.below(3) == 0) ray.tmin = ray.tmax * random.between(0, 1.2);
      switch (random.below(8)) {
        case 0:  // short of the light, or beyond it
          ray.tmax *= random.between(0.9, 1.1);
          break;
        case 1:
          ray.tmax *= random.between(0.9999, 1.0001);
          break;
        case 2:
          ray.tmax = std::nextafter(ray.tmax, random.below(2) == 0 ? 0.0F : 2 * ray.tmax);
          break;
        default:
          break;
      }
    }
  });
}

TEST_P(Packets, AgreeOnShadowsOfAnyLength) {
  check_shadows(random_soup(46, 900, 0.2), 17, [](std::vector<sobb_ray>& rays, Random& random) {
    for (size_t bundle = 0; bundle < rays.size(); bundle += 64) {
      // The longest and the shortest directions, denormal ones among them.
      const int exponent = static_cast<int>(random.below(253)) - 126;
      for (size_t i = bundle; i < bundle + 64; ++i) {
        for (float& d : rays[i].direction) d = std::ldexp(d, exponent);
        rays[i].tmax = std::ldexp(rays[i].tmax, -exponent);
      }
    }
  });
}

TEST_P(Packets, AgreeOnShadowsWithStrangersAmongThem) {
  check_shadows(random_soup(47, 900, 0.2), 18, [](std::vector<sobb_ray>& rays, Random& random) {
    for (sobb_ray& ray : rays) {
      switch (random.below(16)) {
        case 0:  // invalid
          ray.direction[random.below(3)] = std::numeric_limits<float>::quiet_NaN();
          break;
        case 1:
          ray.tmax = std::numeric_limits<float>::quiet_NaN();
          break;
        case 2:  // without an end
          ray.tmax = std::numeric_limits<float>::infinity();
          break;
        case 3:  // empty
          ray.tmax = -ray.tmax;
          break;
        case 4:  // to another light, nearby or not
          ray.direction[random.below(3)] *= random.below(2) == 0 ? 1.0001F : 0.5F;
          break;
        case 5:  // away from the light
          for (float& d : ray.direction) d = -d;
          break;
        case 6:  // from far behind
          for (int k = 0; k < 3; ++k) ray.origin[k] -= 40 * ray.direction[k];
          ray.tmax += 40;
          break;
        case 7:
          ray.tmin = std::numeric_limits<float>::infinity();
          break;
        default:
          break;
      }
    }
  });
}

TEST_P(Packets, AgreeInArraysOfAnyLength) {
  const Soup soup = random_soup(37, 900, 0.2);
  const HierarchyHandle hierarchy = build(soup);
  const std::vector<sobb_ray> all = bundles(soup, kEyes[0], 4e-3, 8);
  for (size_t count = 0; count < 140; ++count) {
    expect_agreement(hierarchy, {all.begin(), all.begin() + static_cast<ptrdiff_t>(count)},
                     std::to_string(count) + " rays");
    if (HasFatalFailure()) return;
  }
}

TEST_P(Packets, AgreeUnderEveryMask) {
  const Soup soup = random_soup(38, 900, 0.2);
  const HierarchyHandle hierarchy = build(soup);
  std::vector<sobb_ray> rays = bundles(soup, kEyes[0], 4e-3, 9);
  rays.resize(16);
  const std::vector<sobb_hit> expected = trace(hierarchy, rays);
  const sobb_hit untouched = {-7, 0, 0, 0, 0, 0};
  Random random(10);
  for (int round = 0; round < 500; ++round) {
    const auto mask = static_cast<uint32_t>(random.bits() & random.bits() & 0xFFFF);
    std::vector<sobb_hit> hits(16, untouched);
    ASSERT_EQ(sobb_intersect_packet(hierarchy.get(), rays.data(), mask, hits.data()), SOBB_OK);
    for (uint32_t i = 0; i < 16; ++i) {
      const bool asked = (mask >> i & 1) != 0;
      ASSERT_TRUE(same(hits[i], asked ? expected[i] : untouched)) << mask << ", ray " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Volumes, Packets, testing::Values(SOBB_VOLUME_AABB, SOBB_VOLUME_SOBB),
                         [](const testing::TestParamInfo<uint32_t>& info) {
                           return info.param == SOBB_VOLUME_AABB ? "aabb" : "sobb";
                         });

}  // namespace
}  // namespace sobb::test
