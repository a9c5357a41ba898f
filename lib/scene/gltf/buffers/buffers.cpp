// SPDX-License-Identifier: Apache-2.0
// See buffers.h.
#include "scene/gltf/buffers/buffers.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "scene/gltf/buffers/meshopt.h"
#include "scene/gltf/buffers/uri.h"

namespace sobb {
namespace {

constexpr uint64_t kMostZeros = 1 << 20;  // elements, over all accessors

}  // namespace

GltfBuffers::GltfBuffers(const GltfDocument& document, std::optional<std::string_view> binary,
                         SceneWriter& writer)
    : document_(document), binary_(binary), writer_(writer), fetched_(document.buffers.size()) {}

void GltfBuffers::refuse(size_t index, const std::string& cause) const {
  const std::string& uri = document_.buffers[index].uri;
  // Only the first buffer may be the binary chunk (glTF 2.0, section 4.4.3).
  const std::string what = is_data_uri(uri) ? "its data URI"
                           : !uri.empty()   ? "'" + uri + "'"
                           : index == 0     ? "the binary chunk"
                                            : "its URI";
  fail(SOBB_ERROR_SCENE_REFERENCE, "%s: buffer %zu: %s %s", writer_.name().c_str(), index,
       what.c_str(), cause.c_str());
}

std::string GltfBuffers::shortage(size_t index, uint64_t bytes) const {
  return "buffer " + std::to_string(index) + " has " + std::to_string(bytes) + " bytes of the " +
         std::to_string(document_.buffers[index].byte_length) + " declared";
}

bool GltfBuffers::take_zeros(uint64_t elements) {
  if (elements > kMostZeros - zeros_) return false;
  zeros_ += elements;
  return true;
}

GltfBuffers::View GltfBuffers::view(size_t index) {
  document_.faults.check(GltfItem::kView, index, writer_.name());
  const GltfView& view = document_.views[index];
  // What is compressed may have its elements in a buffer too, for readers that cannot decompress.
  const bool fallback = !can_decode_meshopt() && has_bytes(view.buffer);
  if (view.compressed && !fallback) {
    return {decompressed(index, *view.compressed), view.compressed->byte_stride};
  }
  const std::string place = "bufferViews[" + std::to_string(index) + "]";
  return {part(view.buffer, view.byte_offset, view.byte_length, place), view.byte_stride};
}

bool GltfBuffers::has_bytes(int buffer) const {
  if (size_t(buffer) >= document_.buffers.size()) return false;
  return !document_.buffers[size_t(buffer)].uri.empty() || (buffer == 0 && binary_);
}

std::string_view GltfBuffers::part(int buffer, uint64_t offset, uint64_t length,
                                   const std::string& place) {
  if (size_t(buffer) >= document_.buffers.size()) {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: %s names no buffer, %d", writer_.name().c_str(),
         place.c_str(), buffer);
  }
  const std::string_view bytes = this->buffer(size_t(buffer));
  if (offset > bytes.size() || length > bytes.size() - offset) {
    if (bytes.size() < document_.buffers[size_t(buffer)].byte_length) {
      fail(SOBB_ERROR_SCENE_REFERENCE, "%s: %s", writer_.name().c_str(),
           shortage(size_t(buffer), bytes.size()).c_str());
    }
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: %s leaves its buffer", writer_.name().c_str(),
         place.c_str());
  }
  return bytes.substr(size_t(offset), size_t(length));
}

std::string_view GltfBuffers::decompressed(size_t index, const GltfMeshopt& compressed) {
  const auto found = decompressed_.find(index);
  if (found != decompressed_.end()) return found->second;
  const std::string place = "bufferViews[" + std::to_string(index) + "]";
  if (!can_decode_meshopt()) decode_meshopt(compressed, {}, place, writer_);  // refuses by name
  const std::string_view data = part(compressed.buffer, compressed.byte_offset,
                                     compressed.byte_length, place + "." + compressed.extension);
  return decompressed_[index] = decode_meshopt(compressed, data, place, writer_);
}

std::string_view GltfBuffers::read_beside(size_t index) {
  const std::vector<std::string> relative = paths_of_uri(document_.buffers[index].uri);
  if (relative.empty()) refuse(index, "is not a relative path");
  const std::string& gltf = writer_.name();
  const std::string folder = gltf.substr(0, gltf.rfind('/') + 1);  // npos + 1 is 0
  const auto there = std::ranges::find_if(
      relative, [&](const std::string& path) { return file_exists(folder + path); });
  const std::string path = folder + (there != relative.end() ? *there : relative[0]);
  const auto found = files_.find(path);
  if (found != files_.end()) return found->second.view();
  try {
    FileBytes bytes = read_file(path, writer_);
    writer_.hold(bytes.size);
    return (files_[path] = std::move(bytes)).view();
  } catch (const Error& error) {
    if (error.status != SOBB_ERROR_FILE_OPEN && error.status != SOBB_ERROR_FILE_READ) throw;
    refuse(index, std::string("cannot be read: ") + error.what());
  }
}

std::string_view GltfBuffers::fetch(size_t index) {
  const GltfBuffer& buffer = document_.buffers[index];
  if (is_data_uri(buffer.uri)) {
    std::optional<std::string> bytes = decode_data_uri(buffer.uri, writer_);
    if (!bytes) refuse(index, "is malformed");
    return decoded_[index] = std::move(*bytes);
  }
  if (!buffer.uri.empty()) return read_beside(index);
  if (index != 0 || !binary_) refuse(index, "is missing");
  return *binary_;
}

std::string_view GltfBuffers::buffer(size_t index) {
  document_.faults.check(GltfItem::kBuffer, index, writer_.name());
  std::optional<std::string_view>& known = fetched_[index];
  if (known) return *known;
  const std::string_view all = fetch(index);
  const uint64_t declared = document_.buffers[index].byte_length;
  if (all.size() < declared) {
    writer_.note(SOBB_NOTE_UNUSED_ITEM, [&] { return shortage(index, all.size()); });
  }
  known = all.substr(0, size_t(declared));
  return *known;
}

}  // namespace sobb
