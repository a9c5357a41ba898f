// SPDX-License-Identifier: Apache-2.0
// The lanes of up to eight that each mask keeps, for compaction.
#pragma once

#include <cstdint>

namespace sobb {

struct CompactTable {
  alignas(64) uint8_t lane[256][8] = {};  // by mask; lowest lane first, zero behind those kept

  constexpr CompactTable() {
    for (uint32_t mask = 0; mask < 256; ++mask) {
      uint32_t kept = 0;
      for (uint8_t i = 0; i < 8; ++i) {
        if ((mask >> i & 1) != 0) lane[mask][kept++] = i;
      }
    }
  }
};

inline constexpr CompactTable kCompactTable;

}  // namespace sobb
