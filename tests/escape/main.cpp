// SPDX-License-Identifier: Apache-2.0
// Rays from inside of closed surfaces, in whatever number: none may escape.
//   escape [RAYS [SEED]]    1,000,000 by default, shared among surfaces, volumes and calls
// Prints what got out, if any, and a line `rays N, escaped N`; the exit code is 1 where one did.
#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "support/closed_meshes.h"

namespace sobb::test {
namespace {

constexpr size_t kBatch = 1 << 16;

void require(sobb_status status) {
  if (status != SOBB_OK) throw std::runtime_error(sobb_last_error());
}

// Traces as many rays, and returns how many escaped.
uint64_t trace_inside(const ClosedMesh& mesh, uint32_t volume, uint64_t rays, uint64_t seed) {
  sobb_build_options build = {};
  build.struct_size = sizeof build;
  build.volume = volume;
  const sobb_triangles triangles = mesh.soup.view();
  sobb_hierarchy* hierarchy = nullptr;
  require(sobb_build(&triangles, &build, &hierarchy));
  uint64_t escaped = 0;
  std::vector<sobb_hit> hits(kBatch);
  for (uint64_t done = 0; done < rays; done += kBatch) {
    const std::vector<sobb_ray> batch =
        rays_from_inside(mesh, seed + done, std::min<uint64_t>(kBatch, rays - done));
    sobb_trace_options options = {};
    options.struct_size = sizeof options;
    options.flags = done / kBatch % 2 == 0 ? 0 : SOBB_TRACE_COHERENT;
    require(sobb_intersect(hierarchy, batch.data(), batch.size(), hits.data(), &options));
    for (size_t i = 0; i < batch.size(); ++i) {
      if (hits[i].primitive != SOBB_MISS) continue;
      ++escaped;
      const sobb_ray& ray = batch[i];
      std::printf("%s, volume %u, seed %" PRIu64 ": o %a %a %a d %a %a %a\n",
                  mesh.soup.name.c_str(), volume, seed + done, ray.origin[0], ray.origin[1],
                  ray.origin[2], ray.direction[0], ray.direction[1], ray.direction[2]);
    }
  }
  sobb_release(hierarchy);
  return escaped;
}

int run(uint64_t rays, uint64_t seed) {
  constexpr uint32_t kVolumes[] = {SOBB_VOLUME_AABB, SOBB_VOLUME_SOBB};
  const std::vector<ClosedMesh> meshes = closed_meshes();
  const uint64_t share = (rays + 2 * meshes.size() - 1) / (2 * meshes.size());
  uint64_t traced = 0;
  uint64_t escaped = 0;
  for (const ClosedMesh& mesh : meshes) {
    for (const uint32_t volume : kVolumes) {
      escaped += trace_inside(mesh, volume, share, seed + traced);
      traced += share;
    }
  }
  std::printf("rays %" PRIu64 ", escaped %" PRIu64 "\n", traced, escaped);
  return escaped == 0 ? 0 : 1;
}

}  // namespace
}  // namespace sobb::test

int main(int count, char** arguments) try {
  const auto number = [&](int i, uint64_t otherwise) {
    return count > i ? std::strtoull(arguments[i], nullptr, 10) : otherwise;
  };
  return sobb::test::run(number(1, 1'000'000), number(2, 1));
} catch (const std::exception& error) {
  std::fprintf(stderr, "escape: %s\n", error.what());
  return 2;
}
