// SPDX-License-Identifier: Apache-2.0
// See mend.h.
#include "fuzz/mend.h"

#include <algorithm>
#include <cstring>
#include <memory_resource>

#include "format/checksum.h"
#include "format/layout.h"

namespace sobb::fuzz {

std::vector<std::byte> mended(std::span<const std::byte> bytes) {
  std::vector<std::byte> file(bytes.begin(), bytes.end());
  if (file.size() < sizeof(FileHeader)) return file;
  FileHeader header;
  std::memcpy(&header, file.data(), sizeof header);
  std::copy_n(kMagic, sizeof kMagic, header.magic);
  header.version = kFormatVersion;
  header.header_size = sizeof header;
  header.total_size = file.size();
  const uint64_t room = (file.size() - sizeof header) / sizeof(Section);
  const uint64_t count = std::min<uint64_t>({header.section_count, room, kMaxSections});
  for (uint64_t i = 0; i < count; ++i) {
    std::byte* const place = &file[sizeof header + i * sizeof(Section)];
    Section section;
    std::memcpy(&section, place, sizeof section);
    if (section.offset > file.size() || section.size > file.size() - section.offset) continue;
    section.checksum = section_checksum(std::span(file).subspan(section.offset, section.size),
                                        Scheduler(1, nullptr), *std::pmr::get_default_resource());
    std::memcpy(place, &section, sizeof section);
  }
  std::memcpy(file.data(), &header, sizeof header);
  const size_t front = sizeof header + count * sizeof(Section);
  header.header_checksum = header_checksum(std::span(file).first(front));
  std::memcpy(file.data(), &header, sizeof header);
  return file;
}

}  // namespace sobb::fuzz
