// SPDX-License-Identifier: Apache-2.0
// Reads a whole file into memory.
//
// The room input/ has what readers of different formats share: files, JSON, binary numbers, Base64
// and progress. It knows model/ only.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "scene/model/scene_writer.h"

namespace sobb {

struct FileBytes {
  std::unique_ptr<char[]> data;
  size_t size = 0;

  std::string_view view() const { return {data.get(), size}; }
};

// Does not hold() the file's bytes. Errors: FILE_OPEN (missing, no permission, no regular file),
// FILE_READ, MEMORY_LIMIT for more bytes than the writer has left, CANCELLED.
FileBytes read_file(const std::string& path, SceneWriter& writer);

bool file_exists(const std::string& path);

}  // namespace sobb
