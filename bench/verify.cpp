// SPDX-License-Identifier: Apache-2.0
// verify() compares our hits with each other bit by bit, and with Embree's by count.
#include "verify.h"

#include <optional>

#include "difference.h"

namespace sobb::bench {
namespace {

struct Reference {
  std::string row;
  TraceOutput output;
};

bool same_as_reference(const Reference& reference, const std::string& row, const RaySet& set,
                       const TraceOutput& output, std::ostream& log) {
  const size_t ray = set.any_hit() ? first_difference(reference.output.occluded, output.occluded)
                                   : first_difference(reference.output.hits, output.hits);
  if (ray == kEqual) return true;
  log << "verify: " << row << " and " << reference.row << " differ at ray " << ray;
  if (!set.any_hit()) {
    const sobb_hit& a = output.hits[ray];
    const sobb_hit& b = reference.output.hits[ray];
    log << ": primitive " << a.primitive << " at t " << a.t << ", primitive " << b.primitive
        << " at t " << b.t;
  }
  log << "\n";
  return false;
}

void compare_peer(const Reference& reference, const std::string& row, const RaySet& set,
                  const TraceOutput& output, std::ostream& log) {
  size_t hit_or_miss = 0;
  size_t primitive = 0;
  for (size_t i = 0; i < set.rays.size(); ++i) {
    if (set.any_hit()) {
      hit_or_miss += output.occluded[i] != reference.output.occluded[i];
    } else {
      const uint32_t ours = reference.output.hits[i].primitive;
      const uint32_t theirs = output.hits[i].primitive;
      hit_or_miss += (ours == SOBB_MISS) != (theirs == SOBB_MISS);
      primitive += ours != theirs && ours != SOBB_MISS && theirs != SOBB_MISS;
    }
  }
  log << "verify: " << row << ": of " << set.rays.size() << " rays " << hit_or_miss
      << " hit by one of us only, " << primitive << " with another primitive\n";
}

}  // namespace

bool verify(Workbench& workbench, std::ostream& log) {
  bool same = true;
  for (const auto& [kind, set] : workbench.ray_sets()) {
    std::optional<Reference> reference;
    for (const auto& [method, subject] : workbench.subjects()) {
      for (const Call call : kCalls) {
        const std::string row = row_name(kind, method, call);
        TraceOutput output;
        output.resize(set);
        subject.trace(set, call, workbench.workers(), output);
        if (!reference) {
          reference = Reference{row, std::move(output)};
        } else {
          same &= same_as_reference(*reference, row, set, output, log);
        }
      }
    }
    if (!reference) continue;
    for (const auto& [method, peer] : workbench.peers()) {
      for (const Call call : kCalls) {
        if (call == Call::kArray && !peer_library()->has_array_call) continue;
        TraceOutput output;
        peer->load(set, call);
        peer->trace(set, call, workbench.workers());
        peer->read(set, call, output);
        compare_peer(*reference, row_name(kind, method, call), set, output, log);
      }
    }
  }
  if (same && !workbench.subjects().empty() && !workbench.ray_sets().empty()) {
    log << "verify: all our hierarchies and calls agree bit by bit\n";
  }
  return same;
}

}  // namespace sobb::bench
