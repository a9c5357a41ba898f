// SPDX-License-Identifier: Apache-2.0
// See glb.h.
#include "scene/gltf/glb.h"

#include <cstdint>

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

GlbChunks split_glb(std::string_view bytes, const std::string& name) {
  if (bytes.size() < kHeaderSize) {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: shorter than the header of a GLB", name.c_str());
  }
  if (word(bytes, 4) != 2) {
    fail(SOBB_ERROR_SCENE_UNSUPPORTED, "%s: GLB version %u, only 2 is read", name.c_str(),
         word(bytes, 4));
  }
  const uint32_t length = word(bytes, 8);
  if (length > bytes.size()) {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: truncated, %zu of %u bytes", name.c_str(), bytes.size(),
         length);
  }
  bytes = bytes.substr(0, length);

  GlbChunks chunks;
  bool first = true;
  for (size_t offset = kHeaderSize; offset < length; first = false) {
    if (length - offset < kChunkHeaderSize) {
      fail(SOBB_ERROR_SCENE_SYNTAX, "%s: a chunk's header at byte %zu is cut off", name.c_str(),
           offset);
    }
    const uint32_t size = word(bytes, offset);
    const uint32_t type = word(bytes, offset + 4);
    offset += kChunkHeaderSize;
    if (size > length - offset) {
      fail(SOBB_ERROR_SCENE_SYNTAX, "%s: the chunk at byte %zu says %u bytes, %zu are left",
           name.c_str(), offset - kChunkHeaderSize, size, length - offset);
    }
    if (first != (type == kJson)) {
      fail(SOBB_ERROR_SCENE_SYNTAX, "%s: the JSON chunk is not the first and only one",
           name.c_str());
    }
    if (type == kJson) chunks.json = bytes.substr(offset, size);
    if (type == kBinary && !chunks.binary) chunks.binary = bytes.substr(offset, size);
    offset += size;
  }
  if (first) fail(SOBB_ERROR_SCENE_SYNTAX, "%s: no JSON chunk", name.c_str());
  return chunks;
}

}  // namespace sobb
