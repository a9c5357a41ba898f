// SPDX-License-Identifier: Apache-2.0
// Handles that release themselves, and the builds and calls that many tests make.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "support/soups.h"

namespace sobb::test {

struct ReleaseHierarchy {
  void operator()(sobb_hierarchy* hierarchy) const { sobb_release(hierarchy); }
};
using HierarchyHandle = std::unique_ptr<sobb_hierarchy, ReleaseHierarchy>;

// What an output holds before a call that is to leave it alone; no hierarchy.
inline sobb_hierarchy* untouched_handle() {
  static char mark;
  return reinterpret_cast<sobb_hierarchy*>(&mark);
}

inline sobb_build_options build_options(uint32_t volume = 0, uint32_t quality = 0,
                                        uint32_t threads = 1) {
  sobb_build_options options = {};
  options.struct_size = sizeof options;
  options.volume = volume;
  options.quality = quality;
  options.threads = threads;
  return options;
}

inline HierarchyHandle build_soup(const Soup& soup,
                                  const sobb_build_options& options = build_options()) {
  sobb_hierarchy* hierarchy = nullptr;
  const sobb_triangles triangles = soup.view();
  EXPECT_EQ(sobb_build(&triangles, &options, &hierarchy), SOBB_OK) << sobb_last_error();
  return HierarchyHandle(hierarchy);
}

// A copy of the file that a hierarchy is.
inline std::string bytes_of(const HierarchyHandle& hierarchy) {
  const void* data = nullptr;
  uint64_t size = 0;
  EXPECT_EQ(sobb_bytes(hierarchy.get(), &data, &size), SOBB_OK) << sobb_last_error();
  return {static_cast<const char*>(data), size};
}

inline sobb_info info_of(const HierarchyHandle& hierarchy) {
  sobb_info info = {};
  info.struct_size = sizeof info;
  EXPECT_EQ(sobb_get_info(hierarchy.get(), &info), SOBB_OK) << sobb_last_error();
  return info;
}

inline sobb_trace_options trace_options(uint32_t flags = 0, uint32_t threads = 1) {
  sobb_trace_options options = {};
  options.struct_size = sizeof options;
  options.flags = flags;
  options.threads = threads;
  return options;
}

inline std::vector<sobb_hit> trace(const HierarchyHandle& hierarchy,
                                   const std::vector<sobb_ray>& rays,
                                   const sobb_trace_options& options = trace_options()) {
  std::vector<sobb_hit> hits(rays.size());
  EXPECT_EQ(sobb_intersect(hierarchy.get(), rays.data(), rays.size(), hits.data(), &options),
            SOBB_OK)
      << sobb_last_error();
  return hits;
}

// What is right by definition.
inline std::vector<sobb_hit> oracle(const Soup& soup, const std::vector<sobb_ray>& rays) {
  std::vector<sobb_hit> hits(rays.size());
  const sobb_triangles triangles = soup.view();
  EXPECT_EQ(sobb_brute_force(&triangles, rays.data(), rays.size(), hits.data(), nullptr), SOBB_OK)
      << sobb_last_error();
  return hits;
}

inline bool same(const sobb_hit& a, const sobb_hit& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}
inline bool same(const std::vector<sobb_hit>& a, const std::vector<sobb_hit>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

}  // namespace sobb::test
