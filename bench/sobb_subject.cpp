// SPDX-License-Identifier: Apache-2.0
// The subject builds and traces through the C ABI. The instruction set is the environment's
// SOBB_ISA, which main sets from the flags, since calls for one ray or a packet take no options.
#include "sobb_subject.h"

#include <algorithm>

#include "check.h"

namespace sobb::bench {

SobbSubject::SobbSubject(const SceneInput& scene, Method method, const Flags& flags,
                         uint32_t build_threads)
    : method_(method), threads_(flags.threads), clock_(flags.threads) {
  sobb_build_options options = SOBB_BUILD_OPTIONS_INIT;
  options.volume = is_aabb(method) ? SOBB_VOLUME_AABB : SOBB_VOLUME_SOBB;
  options.k = flags.k;
  options.quality = is_high(method) ? uint32_t{SOBB_QUALITY_HIGH} : flags.quality;
  options.strategy = flags.strategy;
  if (!is_aabb(method)) options.table = flags.table;
  options.width = flags.width;
  options.threads = build_threads;
  sobb_hierarchy* hierarchy = nullptr;
  build_seconds_ =
      clock_.seconds_of([&] { check(sobb_build(&scene.triangles(), &options, &hierarchy)); });
  hierarchy_.reset(hierarchy);
}

sobb_info SobbSubject::info() const {
  sobb_info info = SOBB_INFO_INIT;
  check(sobb_get_info(hierarchy_.get(), &info));
  return info;
}

void SobbSubject::save(const std::string& path) const {
  check(sobb_save(hierarchy_.get(), path.c_str()));
}

double SobbSubject::trace(const RaySet& set, Call call, Workers& workers,
                          TraceOutput& output) const {
  return clock_.seconds_of([&] {
    switch (call) {
      case Call::kSingle:
        return trace_single<1>(set, workers, output);
      case Call::kPacket:
        return trace_packet(set, workers, output);
      case Call::kArray:
        return trace_array(set, output);
    }
  });
}

double SobbSubject::trace_twice(const RaySet& set, Workers& workers, TraceOutput& output) const {
  return clock_.seconds_of([&] { trace_single<2>(set, workers, output); });
}

template <int kTimes>
void SobbSubject::trace_single(const RaySet& set, Workers& workers, TraceOutput& output) const {
  const auto trace = [&](size_t i) {
    return set.any_hit() ? sobb_occluded1(hierarchy_.get(), &set.rays[i], &output.occluded[i])
                         : sobb_intersect1(hierarchy_.get(), &set.rays[i], &output.hits[i]);
  };
  workers.for_chunks(set.rays.size(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      for (int time = 0; time < kTimes; ++time) check(trace(i));
    }
  });
}

void SobbSubject::trace_packet(const RaySet& set, Workers& workers, TraceOutput& output) const {
  constexpr size_t kPacket = 16;
  workers.for_chunks(set.rays.size(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; i += kPacket) {
      const uint32_t mask = 0xFFFFu >> (kPacket - std::min(kPacket, end - i));
      const sobb_ray* rays = &set.rays[i];
      check(set.any_hit() ? sobb_occluded_packet(hierarchy_.get(), rays, mask, &output.occluded[i])
                          : sobb_intersect_packet(hierarchy_.get(), rays, mask, &output.hits[i]));
    }
  });
}

void SobbSubject::trace_array(const RaySet& set, TraceOutput& output) const {
  sobb_trace_options options = SOBB_TRACE_OPTIONS_INIT;
  options.flags = set.coherent() ? SOBB_TRACE_COHERENT : 0;
  options.threads = threads_;
  const uint64_t count = set.rays.size();
  check(set.any_hit() ? sobb_occluded(hierarchy_.get(), set.rays.data(), count,
                                      output.occluded.data(), &options)
                      : sobb_intersect(hierarchy_.get(), set.rays.data(), count, output.hits.data(),
                                       &options));
}

WorkPerRay SobbSubject::count_work(const RaySet& set) const {
  TraceOutput output;
  output.resize(set);
  std::vector<sobb_count> counts(set.rays.size());
  sobb_trace_options options = SOBB_TRACE_OPTIONS_INIT;
  options.threads = threads_;
  options.counts = counts.data();
  check(set.any_hit() ? sobb_occluded(hierarchy_.get(), set.rays.data(), counts.size(),
                                      output.occluded.data(), &options)
                      : sobb_intersect(hierarchy_.get(), set.rays.data(), counts.size(),
                                       output.hits.data(), &options));
  WorkPerRay work;
  const double share = 1.0 / static_cast<double>(counts.size());
  for (const sobb_count& count : counts) {
    work.nodes += share * count.nodes;
    work.volumes += share * count.volumes;
    work.blocks += share * count.blocks;
    work.triangles += share * count.triangles;
  }
  return work;
}

}  // namespace sobb::bench
