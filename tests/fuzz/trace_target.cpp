// SPDX-License-Identifier: Apache-2.0
// The target that traces a .sobb file that opens. The file may lie about its triangles, but every
// way to trace it is safe, ends, and gives no impossible hit.
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "format/layout.h"
#include "fuzz/mend.h"
#include "fuzz/targets.h"
#include "sobb/sobb.h"
#include "support/supported_isas.h"

namespace sobb::fuzz {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr uint32_t kRays = 320;  // more than a batch needs
constexpr uint32_t kPacket = 16;

// The rays depend on the scene's place and size only: from outside towards it, from within, along
// the axes and nearly so, of no length, beyond all bounds, and invalid ones.
std::vector<sobb_ray> rays_for(const FileHeader& header) {
  constexpr float kZeros[] = {0.0f, -0.0f, 0x1p-140f, 0x1p-60f};
  std::vector<sobb_ray> rays(kRays);
  const float radius = std::fmax(header.radius, 0x1p-100f);
  for (uint32_t i = 0; i < kRays; ++i) {
    const float angle = 0.7f * static_cast<float>(i);
    float direction[3] = {std::cos(angle), std::sin(angle), std::cos(2.3f * angle)};
    if (i % 8 == 1) direction[i % 3] = kZeros[i / 8 % 4];
    if (i % 8 == 2) {
      direction[i % 3] = kZeros[i / 8 % 4];
      direction[(i + 1) % 3] = kZeros[i / 32 % 4];
    }
    const float distance = i % 4 == 0 ? 0.0f : 2 * radius;
    const float scale = i % 16 == 5 ? 0x1p60f : i % 16 == 13 ? 0x1p-60f : 1.0f;
    sobb_ray& ray = rays[i];
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = header.centre[axis] - distance * direction[axis];
      ray.direction[axis] = direction[axis] * scale;
    }
    ray.tmin = i % 5 == 0 ? 0.5f : 0.0f;
    ray.tmax = i % 7 == 0 ? 3 * radius : kInfinity;
  }
  rays[3].direction[1] = std::numeric_limits<float>::quiet_NaN();
  rays[6].origin[2] = kInfinity;
  std::memset(rays[7].direction, 0, sizeof rays[7].direction);
  rays[10].tmin = -1;
  rays[11].tmin = 5;
  rays[11].tmax = 1;
  return rays;
}

void check_hits(const std::vector<sobb_hit>& hits, uint64_t triangles) {
  for (const sobb_hit& hit : hits) {
    const bool none = hit.primitive == SOBB_MISS || hit.primitive == SOBB_INVALID;
    expect(none || hit.primitive < triangles, "a hit names a triangle");
    expect(none ? hit.t == kInfinity : hit.t >= 0 && hit.t < kInfinity, "t is where a ray is");
    expect(hit.u >= 0 && hit.u <= 1 && hit.v >= 0 && hit.v <= 1, "u and v are in the triangle");
  }
}

class Tracer {
 public:
  Tracer(const sobb_hierarchy* hierarchy, const FileHeader& header)
      : hierarchy_(hierarchy),
        triangles_(header.triangle_count),
        rays_(rays_for(header)),
        hits_(kRays),
        occluded_(kRays),
        counts_(kRays) {}

  void arrays(uint32_t isa, uint32_t flags, bool counted) {
    sobb_trace_options options = {};
    options.struct_size = sizeof options;
    options.threads = 1;
    options.isa = isa;
    options.flags = flags;
    options.counts = counted ? counts_.data() : nullptr;
    succeed(sobb_intersect(hierarchy_, rays_.data(), kRays, hits_.data(), &options));
    check_hits(hits_, triangles_);
    succeed(sobb_occluded(hierarchy_, rays_.data(), kRays, occluded_.data(), &options));
  }

  void one_by_one() {
    for (uint32_t i = 0; i < kRays; i += 5) {
      succeed(sobb_intersect1(hierarchy_, &rays_[i], &hits_[i]));
      succeed(sobb_occluded1(hierarchy_, &rays_[i], &occluded_[i]));
    }
    check_hits(hits_, triangles_);
  }

  void packets() {
    for (uint32_t i = 0; i + kPacket <= kRays; i += kPacket) {
      const uint32_t mask = i % (2 * kPacket) == 0 ? 0xFFFF : 0x5A3C;
      succeed(sobb_intersect_packet(hierarchy_, &rays_[i], mask, &hits_[i]));
      succeed(sobb_occluded_packet(hierarchy_, &rays_[i], mask, &occluded_[i]));
    }
    check_hits(hits_, triangles_);
  }

  void statistics() const {
    sobb_info info = {};
    info.struct_size = sizeof info;
    succeed(sobb_get_info(hierarchy_, &info));
    expect(info.triangles == triangles_ && info.blocks > 0, "information is the file's");
  }

 private:
  static void succeed(sobb_status status) { expect(status == SOBB_OK, "tracing succeeds"); }

  const sobb_hierarchy* hierarchy_;
  uint64_t triangles_;
  std::vector<sobb_ray> rays_;
  std::vector<sobb_hit> hits_;
  std::vector<uint8_t> occluded_;
  std::vector<sobb_count> counts_;
};

}  // namespace

void trace(Bytes bytes) {
  const std::vector<std::byte> file = mended(bytes);
  if (file.empty()) return;
  sobb_open_options options = {};
  options.struct_size = sizeof options;
  options.threads = 1;
  sobb_hierarchy* hierarchy = nullptr;
  if (sobb_open_memory(file.data(), file.size(), &options, &hierarchy) != SOBB_OK) return;
  FileHeader header;
  std::memcpy(&header, file.data(), sizeof header);
  Tracer tracer(hierarchy, header);
  for (const sobb_isa isa : test::supported_isas()) {
    tracer.arrays(isa, 0, false);
    tracer.arrays(isa, 0, true);
    tracer.arrays(isa, SOBB_TRACE_COHERENT, false);
  }
  tracer.one_by_one();
  tracer.packets();
  tracer.statistics();
  sobb_release(hierarchy);
}

}  // namespace sobb::fuzz
