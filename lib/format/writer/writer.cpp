// SPDX-License-Identifier: Apache-2.0
#include "format/writer/writer.h"

#include <algorithm>
#include <array>
#include <utility>

#include "format/checksum.h"

namespace sobb {
namespace {

// Small sections come first, so that all that a tool shows of a file is in its first page.
constexpr SectionId kOrder[] = {SectionId::kDirections, SectionId::kRecord, SectionId::kNodes,
                                SectionId::kBlocks};
constexpr uint32_t kSectionCount = std::size(kOrder);

uint64_t size_of(SectionId id, const Shape& shape) {
  switch (id) {
    case SectionId::kDirections:
      return shape.direction_count * sizeof(Direction);
    case SectionId::kRecord:
      return sizeof(BuildRecord);
    case SectionId::kNodes:
      return shape.node_count * node_size(shape.width);
    case SectionId::kBlocks:
      return shape.block_count * sizeof(TriangleBlock);
  }
  return 0;
}

// The section table of a file, checksums aside.
struct SectionTable {
  std::array<Section, kSectionCount> sections = {};
  uint64_t total_size = sizeof(FileHeader) + sizeof sections;

  explicit SectionTable(const Shape& shape) {
    for (uint32_t i = 0; i < kSectionCount; ++i) {
      Section& section = sections[i];
      section.id = static_cast<uint32_t>(kOrder[i]);
      section.offset = (total_size + kSectionAlignment - 1) / kSectionAlignment * kSectionAlignment;
      section.size = size_of(kOrder[i], shape);
      total_size = section.offset + section.size;
    }
  }
};

}  // namespace

Image begin_image(std::shared_ptr<Memory> memory, const Shape& shape, ImageParts& parts,
                  Zeroed zeroed) {
  const SectionTable table(shape);
  const auto& sections = table.sections;
  Image image = Image::allocate(
      std::move(memory), table.total_size,
      zeroed == Zeroed::kAll ? table.total_size : sections[2].offset);  // the nodes are third
  std::byte* const data = image.bytes().data();
  parts.directions = {reinterpret_cast<Direction*>(data + sections[0].offset),
                      shape.direction_count};
  parts.record = reinterpret_cast<BuildRecord*>(data + sections[1].offset);
  parts.nodes = data + sections[2].offset;
  parts.blocks = {reinterpret_cast<TriangleBlock*>(data + sections[3].offset), shape.block_count};
  return image;
}

void finish_image(Image& image, const Shape& shape, const HeaderFields& fields,
                  const Scheduler& scheduler) {
  const std::span<std::byte> bytes = image.bytes();
  SectionTable table(shape);
  for (Section& section : table.sections) {
    section.checksum =
        section_checksum(bytes.subspan(section.offset, section.size), scheduler, image.memory());
  }
  std::ranges::copy(table.sections, reinterpret_cast<Section*>(bytes.data() + sizeof(FileHeader)));

  FileHeader header = {};
  std::ranges::copy(kMagic, header.magic);
  header.version = kFormatVersion;
  header.header_size = sizeof(FileHeader);
  header.total_size = table.total_size;
  header.volume = fields.volume;
  header.width = shape.width;
  header.direction_count = shape.direction_count;
  header.section_count = kSectionCount;
  header.depth = fields.depth;
  std::ranges::copy(fields.centre, header.centre);
  header.radius = fields.radius;
  header.triangle_count = fields.triangle_count;
  auto& in_image = *reinterpret_cast<FileHeader*>(bytes.data());
  in_image = header;
  in_image.header_checksum =
      header_checksum(bytes.first(sizeof(FileHeader) + sizeof table.sections));
}

}  // namespace sobb
