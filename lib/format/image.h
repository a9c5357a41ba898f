// SPDX-License-Identifier: Apache-2.0
// The bytes of a hierarchy: the file, in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "base/memory.h"
#include "base/progress.h"

namespace sobb {

// Owns the bytes of one file image, which are private (from a Memory) or mapped. Move-only.
class Image {
 public:
  Image() = default;
  // Private zeroed bytes, aligned to 64 or, where large, to huge pages.
  static Image allocate(std::shared_ptr<Memory> memory, uint64_t size) {
    return allocate(std::move(memory), size, size);
  }
  // Private bytes of which only the first `zeroed` are zero; the others are to be written.
  static Image allocate(std::shared_ptr<Memory> memory, uint64_t size, uint64_t zeroed);
  // A private copy of a regular file. Progress runs from 0 to `progress_end`. Errors: FILE_OPEN,
  // FILE_READ, OUT_OF_MEMORY, MEMORY_LIMIT, CANCELLED.
  static Image read(std::shared_ptr<Memory> memory, const char* path, Progress& progress,
                    double progress_end);
  // A private copy of bytes in memory. Progress runs likewise. Errors: OUT_OF_MEMORY, MEMORY_LIMIT,
  // CANCELLED.
  static Image copy(std::shared_ptr<Memory> memory, std::span<const std::byte> bytes,
                    Progress& progress, double progress_end);
  // A read-only mapping of a regular file. Errors: FILE_OPEN, FILE_READ.
  static Image map(const char* path);

  Image(Image&& other) noexcept;
  Image& operator=(Image&& other) noexcept;
  ~Image();

  std::span<std::byte> bytes() { return {data_, size_}; }  // private images only
  std::span<const std::byte> bytes() const { return {data_, size_}; }
  Memory& memory() { return *memory_; }  // private images only

 private:
  Image(std::shared_ptr<Memory> memory, uint64_t size);  // leaves the bytes unset

  std::byte* data_ = nullptr;
  uint64_t size_ = 0;
  std::shared_ptr<Memory> memory_;  // null for a mapping
};

}  // namespace sobb
