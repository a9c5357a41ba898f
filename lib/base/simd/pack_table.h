// SPDX-License-Identifier: Apache-2.0
// Which lanes of a vector a mask keeps, lowest first.
#pragma once

#include <cstdint>

namespace sobb {

struct PackTable {
  alignas(64) uint8_t lane[256][8];  // by mask; zero behind those kept

  constexpr PackTable() : lane{} {
    for (uint32_t mask = 0; mask < 256; ++mask) {
      uint32_t kept = 0;
      for (uint8_t i = 0; i < 8; ++i) {
        if ((mask >> i & 1) != 0) lane[mask][kept++] = i;
      }
    }
  }
};

inline constexpr PackTable kPackTable;

}  // namespace sobb
