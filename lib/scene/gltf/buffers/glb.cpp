// SPDX-License-Identifier: Apache-2.0
// See glb.h.
#include "scene/gltf/buffers/glb.h"

#include <cstdint>
#include <string>

#include "base/error.h"
#include "scene/input/load_bytes.h"

namespace sobb {
namespace {

constexpr uint32_t kMagic = 0x46546C67;   // "glTF"
constexpr uint32_t kJson = 0x4E4F534A;    // "JSON"
constexpr uint32_t kBinary = 0x004E4942;  // "BIN"
constexpr size_t kHeaderSize = 12;
constexpr size_t kChunkHeaderSize = 8;

uint32_t word(std::string_view bytes, size_t offset) {
  return load_little<uint32_t>(&bytes[offset]);
}

}  // namespace

bool is_glb(std::string_view bytes) { return bytes.size() >= 4 && word(bytes, 0) == kMagic; }

GlbChunks split_glb(std::string_view bytes, SceneWriter& writer) {
  const char* const name = writer.name().c_str();
  if (bytes.size() < kHeaderSize) {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: shorter than the header of a GLB", name);
  }
  if (word(bytes, 4) != 2) {
    fail(SOBB_ERROR_SCENE_UNSUPPORTED, "%s: glTF %u.0: only 2.x is read", name, word(bytes, 4));
  }
  const size_t length = word(bytes, 8);
  if (length > bytes.size()) {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: truncated, %zu of %zu bytes", name, bytes.size(), length);
  }

  GlbChunks chunks;
  bool first = true;
  size_t offset = kHeaderSize;
  for (; offset + kChunkHeaderSize <= length; first = false) {
    const size_t size = word(bytes, offset);
    const uint32_t type = word(bytes, offset + 4);
    const bool read = first || (type == kBinary && !chunks.binary);
    if (size > bytes.size() - offset - kChunkHeaderSize) {
      if (!read) break;
      fail(SOBB_ERROR_SCENE_SYNTAX, "%s: the chunk at byte %zu says %zu bytes, %zu are left", name,
           offset, size, bytes.size() - offset - kChunkHeaderSize);
    }
    if (first && type != kJson) {
      fail(SOBB_ERROR_SCENE_SYNTAX, "%s: the first chunk is not of JSON", name);
    }
    const std::string_view content = bytes.substr(offset + kChunkHeaderSize, size);
    if (read) (first ? chunks.json : chunks.binary.emplace()) = content;
    offset += kChunkHeaderSize + size;
  }
  if (first) fail(SOBB_ERROR_SCENE_SYNTAX, "%s: no JSON chunk", name);
  if (offset < bytes.size()) {
    writer.note(SOBB_NOTE_SURPLUS, [&] {
      return std::to_string(bytes.size() - offset) + " bytes behind the last chunk, at byte " +
             std::to_string(offset);
    });
  }
  return chunks;
}

}  // namespace sobb
