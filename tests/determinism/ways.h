// SPDX-License-Identifier: Apache-2.0
// Builds and traces every way there is, and throws where one differs.
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "support/soups.h"

namespace sobb::test {

struct Release {
  void operator()(sobb_hierarchy* hierarchy) const { sobb_release(hierarchy); }
};
using Handle = std::unique_ptr<sobb_hierarchy, Release>;

// The options that shape a file, besides the quality.
struct Shape {
  uint32_t volume;
  uint32_t k;
  uint32_t width;
};
inline constexpr Shape kShapes[] = {
    {SOBB_VOLUME_AABB, 6, 8}, {SOBB_VOLUME_SOBB, 32, 4}, {SOBB_VOLUME_SOBB, 64, 8}};

// Builds on 1, 2, 3 and 8 threads of a host that deals its tasks to them in turn, and by every
// instruction set on 1 and on 8 of TBB's. Returns one of the hierarchies, which have to be the
// same.
Handle build_every_way(const Soup& scene, const Shape& shape, uint32_t quality);

std::string_view bytes_of(const Handle& hierarchy);

// Traces `rays` rays through every hierarchy of a scene. Returns the hits, which have to be the
// same.
std::vector<sobb_hit> trace_every_way(const Soup& scene, const std::vector<Handle>& hierarchies,
                                      uint32_t rays);

}  // namespace sobb::test
