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

// Owns the bytes of one file image, private (from a Memory) or mapped. Move-only.
class Image {
 public:
  Image() = default;
  // Private zeroed bytes, aligned to 64 or, where large, to huge pages.
  static Image allocate(std::shared_ptr<Memory> memory, uint64_t size) {
    return allocate(std::move(memory), size, size);
  }
  // The same, of which only the first `zeroed` bytes are zero; the others are to be written.
  static Image allocate(std::shared_ptr<Memory> memory, uint64_t size, uint64_t zeroed);
  // A private copy of a regular file. Progress runs from 0 to `progress_end`. Errors: FILE_OPEN,
  // FILE_READ, OUT_OF_MEMORY, MEMORY_LIMIT, CANCELLED.
  static Image read(std::shared_ptr<Memory> memory, const char* path, Progress& progress,
                    double progress_end);
  // The same of bytes in memory.
  static Image copy(std::shared_ptr<Memory> memory, std::span<const std::byte> bytes,
                    Progress& progress, double progress_end);
  // The file where it lies, read-only. Errors: FILE_OPEN, FILE_READ.
  static Image map(const char* path);

  Image(Image&& other) noexcept;
  Image& operator=(Image&& other) noexcept;
  ~Image();

  std::span<std::byte> bytes() { return {data_, size_}; }  // not of a mapping
  std::span<const std::byte> bytes() const { return {data_, size_}; }
  Memory& memory() { return *memory_; }  // not of a mapping

 private:
  Image(std::shared_ptr<Memory> memory, uint64_t size);  // bytes as they come

  std::byte* data_ = nullptr;
  uint64_t size_ = 0;
  std::shared_ptr<Memory> memory_;  // null for a mapping
};

}  // namespace sobb
