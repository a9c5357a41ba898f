// SPDX-License-Identifier: Apache-2.0
// A whole file in memory.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace sobb {

struct FileBytes {
  std::unique_ptr<char[]> data;
  size_t size = 0;

  std::string_view view() const { return {data.get(), size}; }
};

// Errors: FILE_OPEN (missing, no permission, no regular file), FILE_READ, MEMORY_LIMIT for more
// than `most` bytes.
FileBytes read_file(const std::string& path, uint64_t most);

bool file_exists(const std::string& path);

}  // namespace sobb
