// SPDX-License-Identifier: Apache-2.0
// Which lanes of two vectors of words to take, so that pairs of what a mask keeps come out of them
// in order when the vectors' lower and then their upper halves are interleaved, which AVX2 does
// within blocks of four lanes.
#pragma once

#include <cstdint>

namespace sobb {

struct PushTable {
  alignas(64) uint8_t of_4[16][4] = {};  // by mask; zero behind those kept
  alignas(64) uint8_t of_8[256][8] = {};

  constexpr PushTable() {
    for (uint32_t mask = 0; mask < 16; ++mask) {
      uint32_t kept = 0;
      for (uint8_t i = 0; i < 4; ++i) {
        if ((mask >> i & 1) != 0) of_4[mask][kept++] = i;
      }
    }
    constexpr uint8_t kPlace[8] = {0, 1, 4, 5, 2, 3, 6, 7};
    for (uint32_t mask = 0; mask < 256; ++mask) {
      uint32_t kept = 0;
      for (uint8_t i = 0; i < 8; ++i) {
        if ((mask >> i & 1) != 0) of_8[mask][kPlace[kept++]] = i;
      }
    }
  }

  template <int kLanes>
  const uint8_t* lanes(uint32_t mask) const {
    return kLanes == 4 ? of_4[mask] : of_8[mask];
  }
};

inline constexpr PushTable kPushTable;

}  // namespace sobb
