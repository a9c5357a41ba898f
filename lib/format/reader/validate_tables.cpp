// SPDX-License-Identifier: Apache-2.0
// The two small sections: direction table and build record.
#include <cinttypes>
#include <cmath>

#include "base/error.h"
#include "format/reader/validate.h"

namespace sobb {
namespace {

constexpr double kUnitTolerance = 1e-5;

double length(const Direction& n) {
  const double x = n.x;
  const double y = n.y;
  const double z = n.z;
  return std::sqrt(x * x + y * y + z * z);
}

}  // namespace

void validate_directions(const Reading& reading, const FileView& view) {
  const bool axes = view.header->volume == SOBB_VOLUME_AABB;
  for (uint32_t i = 0; i < view.directions.size(); ++i) {
    const Direction& n = view.directions[i];
    // Written so that NaN fails.
    const bool unit = std::abs(length(n) - 1.0) <= kUnitTolerance;
    const bool axis = n.x == (i == 0) && n.y == (i == 1) && n.z == (i == 2);
    if (!unit || (axes && !axis)) {
      fail(SOBB_ERROR_FORMAT_TABLE, "%s: direction %u: (%g, %g, %g) is not %s", reading.name, i,
           n.x, n.y, n.z, axes ? "that axis" : "of length 1");
    }
  }
}

void validate_record(const Reading& reading, const FileView& view) {
  const BuildRecord& record = *view.record;
  const auto refuse_unless = [&](bool possible, const char* field, double value) {
    if (!possible) {
      fail(SOBB_ERROR_FORMAT_RECORD, "%s: build record: %s is %g", reading.name, field, value);
    }
  };
  refuse_unless(record.quality >= SOBB_QUALITY_LOW && record.quality <= SOBB_QUALITY_HIGH,
                "quality", record.quality);
  refuse_unless(record.strategy >= SOBB_STRATEGY_K && record.strategy <= SOBB_STRATEGY_K3,
                "strategy", record.strategy);
  refuse_unless(record.degenerate_count <= view.header->triangle_count, "degenerate_count",
                static_cast<double>(record.degenerate_count));
  for (int axis = 0; axis < 3; ++axis) {
    const float low = record.bounds_min[axis];
    const float high = record.bounds_max[axis];
    refuse_unless(within(low, kMaxCoordinate), "bounds_min", low);
    refuse_unless(within(high, kMaxCoordinate) && high >= low, "bounds_max", high);
  }
  for (const uint32_t reserved : record.reserved) {
    refuse_unless(reserved == 0, "reserved", reserved);
  }
}

}  // namespace sobb
