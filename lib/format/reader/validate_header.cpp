// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cinttypes>
#include <cmath>

#include "base/error.h"
#include "format/checksum.h"
#include "format/reader/validate.h"

namespace sobb {
namespace {

void validate_fields(const FileHeader& header, const char* name) {
  const auto refuse_unless = [&](bool possible, const char* field, double value) {
    if (!possible) fail(SOBB_ERROR_FORMAT_HEADER, "%s: header: %s is %g", name, field, value);
  };
  refuse_unless(header.volume == SOBB_VOLUME_AABB || header.volume == SOBB_VOLUME_SOBB, "volume",
                header.volume);
  refuse_unless(header.width == 4 || header.width == 8, "width", header.width);
  const uint32_t k = header.direction_count;
  const bool aabb = header.volume == SOBB_VOLUME_AABB;
  refuse_unless(aabb ? k == 3 : k == 16 || k == 24 || k == 32,
                aabb ? "direction_count of AABBs" : "direction_count of SOBBs", k);
  refuse_unless(header.reserved0 == 0, "reserved0", header.reserved0);
  for (const float c : header.centre) refuse_unless(within(c, kMaxCoordinate), "centre", c);
  refuse_unless(within(header.radius, kMaxExtent) && !std::signbit(header.radius), "radius",
                header.radius);
  refuse_unless(header.triangle_count >= 1 && header.triangle_count <= SOBB_MAX_TRIANGLES,
                "triangle_count", static_cast<double>(header.triangle_count));
  for (const uint64_t r : header.reserved1) {
    refuse_unless(r == 0, "reserved1", static_cast<double>(r));
  }
  if (header.depth < 1 || header.depth > kMaxDepth) {
    fail(SOBB_ERROR_FORMAT_DEPTH, "%s: header: depth is %u, not 1 to %u", name, header.depth,
         kMaxDepth);
  }
}

}  // namespace

const FileHeader& validate_header(const Reading& reading) {
  const std::span<const std::byte> bytes = reading.bytes;
  const char* const name = reading.name;
  const size_t compared = std::min(bytes.size(), sizeof kMagic);
  if (!std::ranges::equal(bytes.first(compared), std::as_bytes(std::span(kMagic, compared)))) {
    fail(SOBB_ERROR_FORMAT_MAGIC, "%s: not a sobb file: it begins with other bytes", name);
  }
  if (bytes.size() < sizeof(FileHeader)) {
    fail(SOBB_ERROR_FORMAT_SIZE, "%s: truncated: %zu bytes, the header alone has %zu", name,
         bytes.size(), sizeof(FileHeader));
  }
  const FileHeader& header = *reinterpret_cast<const FileHeader*>(bytes.data());
  if (header.version != kFormatVersion) {
    fail(SOBB_ERROR_FORMAT_VERSION, "%s: format version %u, this library reads version %u", name,
         header.version, kFormatVersion);
  }
  if (header.total_size != bytes.size()) {
    fail(SOBB_ERROR_FORMAT_SIZE, "%s: %s: %zu bytes, the header says %" PRIu64, name,
         bytes.size() < header.total_size ? "truncated" : "bytes after its end", bytes.size(),
         header.total_size);
  }
  if (header.header_size != sizeof(FileHeader)) {
    fail(SOBB_ERROR_FORMAT_HEADER, "%s: header: header_size is %u, not %zu", name,
         header.header_size, sizeof(FileHeader));
  }
  if (header.section_count > kMaxSections ||
      header.section_count * sizeof(Section) > bytes.size() - sizeof(FileHeader)) {
    fail(SOBB_ERROR_FORMAT_HEADER,
         "%s: header: section_count is %u: more than %u, or than the file holds", name,
         header.section_count, kMaxSections);
  }
  const size_t front = sizeof(FileHeader) + header.section_count * sizeof(Section);
  if (header.header_checksum != header_checksum(bytes.first(front))) {
    fail(SOBB_ERROR_FORMAT_HEADER, "%s: header: its checksum differs", name);
  }
  if (header.must_understand != 0) {
    fail(SOBB_ERROR_FORMAT_FEATURE,
         "%s: needs features 0x%08" PRIX32 ", of which this library has none", name,
         header.must_understand);
  }
  validate_fields(header, name);
  return header;
}

}  // namespace sobb
