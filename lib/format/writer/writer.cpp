// SPDX-License-Identifier: Apache-2.0
#include "format/writer/writer.h"

#include <algorithm>
#include <utility>

#include "format/checksum.h"

namespace sobb {
namespace {

// Small sections first, so that what a tool shows of a file is in its first page.
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

}  // namespace

Image begin_image(std::shared_ptr<Memory> memory, const Shape& shape, ImageParts& parts,
                  Zeroed zeroed) {
  Section sections[kSectionCount] = {};
  uint64_t end = sizeof(FileHeader) + sizeof sections;
  for (uint32_t i = 0; i < kSectionCount; ++i) {
    const uint64_t offset = (end + kSectionAlignment - 1) / kSectionAlignment * kSectionAlignment;
    sections[i].id = static_cast<uint32_t>(kOrder[i]);
    sections[i].offset = offset;
    sections[i].size = size_of(kOrder[i], shape);
    end = offset + sections[i].size;
  }

  Image image =
      Image::allocate(std::move(memory), end, zeroed == Zeroed::kAll ? end : sections[2].offset);
  std::byte* const data = image.bytes().data();
  auto* const header = reinterpret_cast<FileHeader*>(data);
  std::ranges::copy(kMagic, header->magic);
  header->version = kFormatVersion;
  header->header_size = sizeof(FileHeader);
  header->total_size = end;
  header->width = shape.width;
  header->direction_count = shape.direction_count;
  header->section_count = kSectionCount;
  std::ranges::copy(sections, reinterpret_cast<Section*>(data + sizeof(FileHeader)));

  parts.header = header;
  parts.directions = {reinterpret_cast<Direction*>(data + sections[0].offset),
                      shape.direction_count};
  parts.record = reinterpret_cast<BuildRecord*>(data + sections[1].offset);
  parts.nodes = data + sections[2].offset;
  parts.blocks = {reinterpret_cast<TriangleBlock*>(data + sections[3].offset), shape.block_count};
  return image;
}

void seal_image(Image& image, const Scheduler& scheduler) {
  const std::span<std::byte> bytes = image.bytes();
  auto* const header = reinterpret_cast<FileHeader*>(bytes.data());
  const std::span sections(reinterpret_cast<Section*>(bytes.data() + sizeof(FileHeader)),
                           header->section_count);
  for (Section& section : sections) {
    section.checksum =
        section_checksum(bytes.subspan(section.offset, section.size), scheduler, image.memory());
  }
  header->header_checksum =
      header_checksum(bytes.first(sizeof(FileHeader) + sections.size_bytes()));
}

}  // namespace sobb
