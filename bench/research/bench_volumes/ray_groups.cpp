// SPDX-License-Identifier: Apache-2.0
// Makes the rays, and compares hits with those that all methods must find.
#include "bench_volumes/ray_groups.h"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "check.h"
#include "difference.h"

namespace sobb::bench::volumes {
namespace {

constexpr uint32_t kBounces = 7;
constexpr size_t kBruteForceRays = 100;  // per group

std::string in_words(const sobb_hit& hit) {
  std::ostringstream words;
  words << std::setprecision(std::numeric_limits<float>::max_digits10) << "primitive "
        << hit.primitive << " at t " << hit.t << ", u " << hit.u << ", v " << hit.v;
  return words.str();
}

[[noreturn]] void fail_at(const std::string& method, const RayGroup& group, size_t ray,
                          const sobb_hit& hit, const sobb_hit& expected) {
  throw std::runtime_error(method + ": ray " + std::to_string(ray) + " of " + group.name +
                           " hits " + in_words(hit) + ", not " + in_words(expected));
}

}  // namespace

RayGroups make_ray_groups(const SceneInput& scene, uint32_t size, const ClosestHits& closest_hits) {
  RaySet primary = primary_rays(scene.view(), size);
  RaySet secondary = path_rays(scene.triangles(), scene.info(), primary, kBounces, closest_hits);
  if (secondary.rays.empty()) throw std::runtime_error("no primary ray of this view hits anything");
  RayGroups groups{
      {{"primary", std::move(primary.rays), {}}, {"secondary", std::move(secondary.rays), {}}}};
  return groups;
}

void expect_same_hits(const std::string& method, const RayGroup& group,
                      const std::vector<sobb_hit>& hits) {
  const size_t ray = first_difference(group.hits, hits);
  if (ray != kEqual) fail_at(method, group, ray, hits[ray], group.hits[ray]);
}

uint64_t expect_brute_force(const std::string& method, const RayGroup& group,
                            const sobb_triangles& triangles, uint32_t threads) {
  const size_t count = std::min(kBruteForceRays, group.rays.size());
  std::vector<size_t> places(count);
  std::vector<sobb_ray> rays(count);
  for (size_t i = 0; i < count; ++i) {
    places[i] = i * group.rays.size() / count;
    rays[i] = group.rays[places[i]];
  }
  std::vector<sobb_hit> expected(count), hits(count);
  sobb_trace_options options = SOBB_TRACE_OPTIONS_INIT;
  options.threads = threads;
  check(sobb_brute_force(&triangles, rays.data(), count, expected.data(), &options));
  for (size_t i = 0; i < count; ++i) hits[i] = group.hits[places[i]];
  const size_t i = first_difference(hits, expected);
  if (i != kEqual) fail_at(method, group, places[i], hits[i], expected[i]);
  return count;
}

}  // namespace sobb::bench::volumes
