// SPDX-License-Identifier: Apache-2.0
// kMethods lists the methods of the comparison: the bounding volumes of EG25's table, by their
// names there.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace sobb::study {

enum class VolumeKind { kAabb, kDop14, kObb, kSobbDirect, kSobbIndexed };

struct Method {
  std::string_view name;
  VolumeKind volume;
  uint32_t k;  // planes of the k-DOP that the volume is chosen from; 0 where there is none

  // True where a strategy chooses the volume among the triples of a table.
  constexpr bool has_strategy() const {
    return volume == VolumeKind::kSobbDirect || volume == VolumeKind::kSobbIndexed;
  }
};

inline constexpr std::array<Method, 11> kMethods = {{
    {"AABB", VolumeKind::kAabb, 6},
    {"14-DOP", VolumeKind::kDop14, 14},
    {"OBB", VolumeKind::kObb, 0},
    {"SOBB 32d", VolumeKind::kSobbDirect, 32},
    {"SOBB 32i", VolumeKind::kSobbIndexed, 32},
    {"SOBB 48d", VolumeKind::kSobbDirect, 48},
    {"SOBB 48i", VolumeKind::kSobbIndexed, 48},
    {"SOBB 64d", VolumeKind::kSobbDirect, 64},
    {"SOBB 64i", VolumeKind::kSobbIndexed, 64},
    {"SOBB 128", VolumeKind::kSobbDirect, 128},
    {"SOBB 256", VolumeKind::kSobbDirect, 256},
}};

}  // namespace sobb::study
