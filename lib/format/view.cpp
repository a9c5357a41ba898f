// SPDX-License-Identifier: Apache-2.0
#include "format/view.h"

#include <algorithm>

namespace sobb {
namespace {

template <class Item>
std::span<const Item> items_of(std::span<const std::byte> bytes, SectionId id) {
  const auto& header = *reinterpret_cast<const FileHeader*>(bytes.data());
  const std::span sections(reinterpret_cast<const Section*>(bytes.data() + sizeof(FileHeader)),
                           header.section_count);
  const Section& section = *std::ranges::find(sections, static_cast<uint32_t>(id), &Section::id);
  return {reinterpret_cast<const Item*>(bytes.data() + section.offset),
          section.size / sizeof(Item)};
}

}  // namespace

FileView view_of(std::span<const std::byte> bytes) {
  FileView view;
  view.header = reinterpret_cast<const FileHeader*>(bytes.data());
  view.directions = items_of<Direction>(bytes, SectionId::kDirections);
  const auto nodes = items_of<std::byte>(bytes, SectionId::kNodes);
  view.nodes = nodes.data();
  view.node_count = nodes.size() / node_size(view.header->width);
  view.blocks = items_of<TriangleBlock>(bytes, SectionId::kBlocks);
  view.record = items_of<BuildRecord>(bytes, SectionId::kRecord).data();
  return view;
}

}  // namespace sobb
