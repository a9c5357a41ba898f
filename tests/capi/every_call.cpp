// SPDX-License-Identifier: Apache-2.0
#include "capi/every_call.h"
#include "support/supported_isas.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace sobb::test {
namespace {

std::string describe(const sobb_ray& ray) {
  char text[256];
  std::snprintf(text, sizeof text, "ray o %a %a %a d %a %a %a t %a %a", ray.origin[0],
                ray.origin[1], ray.origin[2], ray.direction[0], ray.direction[1], ray.direction[2],
                ray.tmin, ray.tmax);
  return text;
}

void expect_same(const std::vector<sobb_hit>& hits, const std::vector<sobb_hit>& expected,
                 const std::vector<sobb_ray>& rays, const std::string& what) {
  int shown = 0;
  for (size_t i = 0; i < hits.size() && shown < 3; ++i) {
    if (std::memcmp(&hits[i], &expected[i], sizeof hits[i]) == 0) continue;
    ++shown;
    ADD_FAILURE() << what << ": ray " << i << " hits " << hits[i].primitive << " at " << hits[i].t
                  << ", not " << expected[i].primitive << " at " << expected[i].t << "; "
                  << describe(rays[i]);
  }
}

void expect_same(const std::vector<uint8_t>& occluded, const std::vector<sobb_hit>& expected,
                 const std::vector<sobb_ray>& rays, const std::string& what) {
  int shown = 0;
  for (size_t i = 0; i < occluded.size() && shown < 3; ++i) {
    const uint8_t right = expected[i].primitive == SOBB_INVALID ? SOBB_OCCLUDED_INVALID
                          : expected[i].primitive == SOBB_MISS  ? SOBB_FREE
                                                                : SOBB_OCCLUDED;
    if (occluded[i] == right) continue;
    ++shown;
    ADD_FAILURE() << what << ": ray " << i << " occluded " << int{occluded[i]} << ", not "
                  << int{right} << "; " << describe(rays[i]);
  }
}

}  // namespace

void check_calls(const HierarchyHandle& hierarchy, const std::vector<sobb_ray>& rays,
                 const std::vector<sobb_hit>& expected, const std::string& what) {
  std::vector<sobb_hit> hits(rays.size());
  std::vector<uint8_t> occluded(rays.size());
  for (const sobb_isa isa : supported_isas()) {
    for (const uint32_t flags : {0U, static_cast<uint32_t>(SOBB_TRACE_COHERENT)}) {
      const std::string call =
          what + " isa " + std::to_string(isa) + " flags " + std::to_string(flags);
      const sobb_trace_options options = {sizeof options, flags, 1, isa, nullptr, nullptr, nullptr};
      ASSERT_EQ(sobb_intersect(hierarchy.get(), rays.data(), rays.size(), hits.data(), &options),
                SOBB_OK);
      expect_same(hits, expected, rays, call);
      ASSERT_EQ(sobb_occluded(hierarchy.get(), rays.data(), rays.size(), occluded.data(), &options),
                SOBB_OK);
      expect_same(occluded, expected, rays, call);
    }
  }
  for (size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(sobb_intersect1(hierarchy.get(), &rays[i], &hits[i]), SOBB_OK);
    ASSERT_EQ(sobb_occluded1(hierarchy.get(), &rays[i], &occluded[i]), SOBB_OK);
  }
  expect_same(hits, expected, rays, what + " single");
  expect_same(occluded, expected, rays, what + " single");
  constexpr size_t kPacket = 16;
  for (size_t first = 0; first < rays.size(); first += kPacket) {
    const size_t size = std::min(kPacket, rays.size() - first);
    const auto mask = static_cast<uint32_t>((1U << size) - 1);
    ASSERT_EQ(sobb_intersect_packet(hierarchy.get(), &rays[first], mask, &hits[first]), SOBB_OK);
    ASSERT_EQ(sobb_occluded_packet(hierarchy.get(), &rays[first], mask, &occluded[first]), SOBB_OK);
  }
  expect_same(hits, expected, rays, what + " packet");
  expect_same(occluded, expected, rays, what + " packet");
}

}  // namespace sobb::test
