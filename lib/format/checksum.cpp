// SPDX-License-Identifier: Apache-2.0
#include "format/checksum.h"

#include "base/xxh3.h"

#include <algorithm>
#include <array>
#include <vector>

namespace sobb {

uint64_t header_checksum(std::span<const std::byte> front) {
  std::array<std::byte, sizeof(FileHeader) + kMaxSections * sizeof(Section)> copy;
  std::ranges::copy(front, copy.begin());
  std::fill_n(copy.begin() + offsetof(FileHeader, header_checksum), sizeof(uint64_t), std::byte{0});
  return XXH3_64bits(copy.data(), front.size());
}

uint64_t section_checksum(std::span<const std::byte> section, const Scheduler& scheduler,
                          std::pmr::memory_resource& scratch, ProgressStage* stage) {
  const uint64_t chunk_count = (section.size() + kChecksumChunk - 1) / kChecksumChunk;
  std::pmr::vector<uint64_t> hashes(chunk_count, &scratch);
  scheduler.for_each(chunk_count, [&](uint64_t chunk) {
    const uint64_t begin = chunk * kChecksumChunk;
    const uint64_t size = std::min<uint64_t>(kChecksumChunk, section.size() - begin);
    hashes[chunk] = XXH3_64bits(section.data() + begin, size);
    if (stage != nullptr) stage->advance(size);
  });
  return XXH3_64bits(hashes.data(), hashes.size() * sizeof(uint64_t));
}

}  // namespace sobb
