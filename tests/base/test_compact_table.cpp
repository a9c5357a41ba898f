// SPDX-License-Identifier: Apache-2.0
// The table that compaction takes its lanes from.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "base/simd/compact_table.h"

namespace sobb::test {
namespace {

TEST(CompactTable, KeepsLanesInOrder) {
  for (uint32_t mask = 0; mask < 256; ++mask) {
    int kept = 0;
    for (uint8_t lane = 0; lane < 8; ++lane) {
      if ((mask >> lane & 1) == 0) continue;
      EXPECT_EQ(kCompactTable.lane[mask][kept++], lane) << mask;
    }
    EXPECT_EQ(kept, std::popcount(mask));
    for (; kept < 8; ++kept) EXPECT_EQ(kCompactTable.lane[mask][kept], 0) << mask;
  }
}

}  // namespace
}  // namespace sobb::test
