// SPDX-License-Identifier: Apache-2.0
#include "determinism/ways.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "support/supported_isas.h"

namespace sobb::test {
namespace {

constexpr uint32_t kPacket = 16;

void require(sobb_status status) {
  if (status != SOBB_OK) throw std::runtime_error(sobb_last_error());
}

// A host's scheduler that deals tasks to its threads in turn, so that all have some.
struct Dealer {
  uint32_t threads;
  size_t most = 0;  // threads that a loop had

  static void parallel_for(void* user, uint64_t count, void (*body)(void*, uint64_t),
                           void* context) {
    auto* self = static_cast<Dealer*>(user);
    std::vector<std::thread> threads;
    for (uint64_t first = 0; first < std::min<uint64_t>(self->threads, count); ++first) {
      threads.emplace_back([=] {
        for (uint64_t i = first; i < count; i += self->threads) body(context, i);
      });
    }
    for (std::thread& thread : threads) thread.join();
    self->most = std::max(self->most, threads.size());
  }
};

Handle build(const Soup& scene, const sobb_build_options& options) {
  const sobb_triangles triangles = scene.view();
  sobb_hierarchy* hierarchy = nullptr;
  require(sobb_build(&triangles, &options, &hierarchy));
  return Handle(hierarchy);
}

Handle build_dealt(const Soup& scene, sobb_build_options options) {
  Dealer dealer{options.threads};
  const sobb_scheduler scheduler = {&dealer, Dealer::parallel_for};
  options.scheduler = &scheduler;
  Handle hierarchy = build(scene, options);
  if (options.threads > 1 && dealer.most < 2) {
    throw std::runtime_error(scene.name + ": all ran on one thread");
  }
  return hierarchy;
}

using Hits = std::vector<sobb_hit>;

Hits trace_array(const Handle& hierarchy, const std::vector<sobb_ray>& rays,
                 const sobb_trace_options& options) {
  Hits hits(rays.size());
  require(sobb_intersect(hierarchy.get(), rays.data(), rays.size(), hits.data(), &options));
  return hits;
}

Hits trace_packets(const Handle& hierarchy, const std::vector<sobb_ray>& rays) {
  Hits hits(rays.size());
  for (size_t i = 0; i < rays.size(); i += kPacket) {
    const size_t count = std::min<size_t>(kPacket, rays.size() - i);
    require(sobb_intersect_packet(hierarchy.get(), &rays[i], (uint32_t{1} << count) - 1, &hits[i]));
  }
  return hits;
}

void compare(const Hits& a, const Hits& b, const std::string& what) {
  if (std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) != 0) {
    throw std::runtime_error(what + ": other hits");
  }
}

}  // namespace

Handle build_every_way(const Soup& scene, const Shape& shape, uint32_t quality) {
  sobb_build_options options = {};
  options.struct_size = sizeof options;
  options.volume = shape.volume;
  options.k = shape.volume == SOBB_VOLUME_AABB ? 0 : shape.k;
  options.width = shape.width;
  options.quality = quality;
  options.threads = 1;
  Handle first = build(scene, options);
  const auto check = [&](const Handle& other) {
    if (bytes_of(other) == bytes_of(first)) return;
    throw std::runtime_error(scene.name + ", quality " + std::to_string(quality) + ": " +
                             std::to_string(options.threads) + " threads, instruction set " +
                             std::to_string(options.isa) + ": other bytes");
  };
  for (const uint32_t threads : {2, 3, 8}) {
    options.threads = threads;
    check(build_dealt(scene, options));
  }
  for (const sobb_isa isa : supported_isas()) {
    options.isa = isa;
    for (const uint32_t threads : {1, 8}) {
      options.threads = threads;
      check(build(scene, options));
    }
  }
  return first;
}

std::string_view bytes_of(const Handle& hierarchy) {
  const void* data = nullptr;
  uint64_t size = 0;
  require(sobb_bytes(hierarchy.get(), &data, &size));
  return {static_cast<const char*>(data), size};
}

std::vector<sobb_hit> trace_every_way(const Soup& scene, const std::vector<Handle>& hierarchies,
                                      uint32_t count) {
  const std::vector<sobb_ray> rays = mixed_rays(scene, 1, count);
  std::vector<sobb_count> counts(rays.size());
  sobb_trace_options options = {};
  options.struct_size = sizeof options;
  options.threads = 1;
  const Hits expected = trace_array(hierarchies[0], rays, options);
  for (const Handle& hierarchy : hierarchies) {
    for (const sobb_isa isa : supported_isas()) {
      options.isa = isa;
      for (const uint32_t threads : {1U, 8U}) {
        options.threads = threads;
        for (const uint32_t flags : {0U, static_cast<uint32_t>(SOBB_TRACE_COHERENT)}) {
          options.flags = flags;
          compare(trace_array(hierarchy, rays, options), expected, scene.name);
        }
      }
      options.flags = 0;
      options.counts = counts.data();
      compare(trace_array(hierarchy, rays, options), expected, scene.name + ", counted");
      options.counts = nullptr;
    }
    compare(trace_packets(hierarchy, rays), expected, scene.name + ", packets");
  }
  return expected;
}

}  // namespace sobb::test
