// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cinttypes>
#include <tuple>

#include "base/error.h"
#include "format/checksum.h"
#include "format/reader/validate.h"

namespace sobb {
namespace {

constexpr uint64_t kMaxIndexed = uint64_t{1} << 32;  // as many as a node's reference can tell apart

// Proves that sections are aligned and lie in the file.
void validate_ranges(const Reading& reading, std::span<const Section> sections) {
  for (size_t i = 0; i < sections.size(); ++i) {
    const Section& section = sections[i];
    const auto refuse = [&](const char* cause) {
      fail(SOBB_ERROR_FORMAT_SECTION,
           "%s: section %zu (id %u): %s (offset %" PRIu64 ", size %" PRIu64 ")", reading.name, i,
           section.id, cause, section.offset, section.size);
    };
    if (section.reserved != 0) refuse("its reserved field is not zero");
    if (section.offset % kSectionAlignment != 0) refuse("not aligned");
    if (section.offset > reading.bytes.size() ||
        section.size > reading.bytes.size() - section.offset) {
      refuse("beyond the end of the file");
    }
  }
}

// Proves that sections are disjoint, lie behind the table, and have zeros between them. With the
// checksums no byte of the file can then change unnoticed.
void validate_gaps(const Reading& reading, std::span<const Section> sections,
                   ProgressStage& stage) {
  std::array<Section, kMaxSections> storage;
  const std::span sorted = std::span(storage).first(sections.size());
  std::ranges::copy(sections, sorted.begin());
  std::ranges::sort(sorted, {}, [](const Section& s) { return std::tuple(s.offset, s.size); });

  uint64_t end = sizeof(FileHeader) + sections.size_bytes();
  const auto expect_zero = [&](uint64_t next) {
    for (uint64_t begin = end; begin < next; begin += kChecksumChunk) {
      const auto gap = reading.bytes.subspan(begin, std::min(next - begin, kChecksumChunk));
      const auto set = std::ranges::find_if(gap, [](std::byte b) { return b != std::byte{0}; });
      if (set != gap.end()) {
        fail(SOBB_ERROR_FORMAT_SECTION, "%s: byte %" PRIu64 " is in no section and not zero",
             reading.name, begin + static_cast<uint64_t>(set - gap.begin()));
      }
      stage.advance(gap.size());
    }
  };
  for (const Section& section : sorted) {
    if (section.offset < end) {
      fail(SOBB_ERROR_FORMAT_SECTION,
           "%s: the section at offset %" PRIu64
           " (id %u) overlaps "
           "what is before it",
           reading.name, section.offset, section.id);
    }
    expect_zero(section.offset);
    end = section.offset + section.size;
  }
  expect_zero(reading.bytes.size());
}

const Section& find_section(const Reading& reading, std::span<const Section> sections, SectionId id,
                            const char* what) {
  const auto is_it = [&](const Section& s) { return s.id == static_cast<uint32_t>(id); };
  const auto count = std::ranges::count_if(sections, is_it);
  if (count != 1) {
    fail(SOBB_ERROR_FORMAT_SECTION, "%s: %td sections of the %s (id %u), not one", reading.name,
         count, what, static_cast<uint32_t>(id));
  }
  return *std::ranges::find_if(sections, is_it);
}

// Proves that there is one section of an id, and that it holds [least, most] items.
void validate_items(const Reading& reading, std::span<const Section> sections, SectionId id,
                    const char* what, uint64_t item_size, uint64_t least, uint64_t most) {
  const Section& section = find_section(reading, sections, id, what);
  const uint64_t count = section.size / item_size;
  if (section.size % item_size != 0 || count < least || count > most) {
    fail(SOBB_ERROR_FORMAT_SECTION,
         "%s: the %s (section id %u) has %" PRIu64 " bytes, not %" PRIu64 " to %" PRIu64
         " times %" PRIu64,
         reading.name, what, section.id, section.size, least, most, item_size);
  }
}

void validate_checksums(const Reading& reading, std::span<const Section> sections,
                        ProgressStage& stage) {
  for (const Section& section : sections) {
    const auto bytes = reading.bytes.subspan(section.offset, section.size);
    if (section_checksum(bytes, reading.scheduler, reading.scratch, &stage) != section.checksum) {
      fail(SOBB_ERROR_FORMAT_CHECKSUM,
           "%s: the checksum of the section at offset %" PRIu64 " (id %u) differs", reading.name,
           section.offset, section.id);
    }
  }
}

}  // namespace

void validate_sections(const Reading& reading, const FileHeader& header) {
  const std::span sections(
      reinterpret_cast<const Section*>(reading.bytes.data() + sizeof(FileHeader)),
      header.section_count);
  validate_ranges(reading, sections);
  ProgressStage stage(reading.progress, kReadEnd, kChecksumsEnd, reading.bytes.size());
  validate_gaps(reading, sections, stage);

  validate_items(reading, sections, SectionId::kDirections, "direction table", sizeof(Direction),
                 header.direction_count, header.direction_count);
  validate_items(reading, sections, SectionId::kRecord, "build record", sizeof(BuildRecord), 1, 1);
  validate_items(reading, sections, SectionId::kNodes, "nodes", node_size(header.width), 1,
                 kMaxIndexed);
  validate_items(reading, sections, SectionId::kBlocks, "triangle blocks", sizeof(TriangleBlock), 1,
                 kMaxIndexed);
  validate_checksums(reading, sections, stage);
}

}  // namespace sobb
