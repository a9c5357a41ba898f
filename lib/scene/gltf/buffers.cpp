// SPDX-License-Identifier: Apache-2.0
// See buffers.h.
#include "scene/gltf/buffers.h"

#include <utility>

#include "base/error.h"
#include "scene/input/base64.h"

namespace sobb {
namespace {

constexpr uint64_t kMostZeros = 1 << 20;  // elements, over all accessors

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

// The URI with its percent-encoded bytes (RFC 3986, section 2.1) decoded.
std::string unescaped(std::string_view uri) {
  std::string result;
  for (size_t i = 0; i < uri.size(); ++i) {
    const bool escape = uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 &&
                        hex_digit(uri[i + 2]) >= 0;
    result += escape ? char(hex_digit(uri[i + 1]) * 16 + hex_digit(uri[i + 2])) : uri[i];
    if (escape) i += 2;
  }
  return result;
}

}  // namespace

GltfBuffers::GltfBuffers(const std::vector<GltfBuffer>& buffers,
                         std::optional<std::string_view> binary, SceneWriter& writer)
    : buffers_(buffers), binary_(binary), writer_(writer), fetched_(buffers.size()) {}

void GltfBuffers::refuse(size_t index, const std::string& cause) const {
  const std::string& uri = buffers_[index].uri;
  const std::string what = uri.empty()                ? "the binary chunk"
                           : uri.starts_with("data:") ? "its data URI"
                                                      : "'" + uri + "'";
  fail(SOBB_ERROR_SCENE_REFERENCE, "%s: buffer %zu: %s %s", writer_.name().c_str(), index,
       what.c_str(), cause.c_str());
}

bool GltfBuffers::take_zeros(uint64_t elements) {
  if (elements > kMostZeros - zeros_) return false;
  zeros_ += elements;
  return true;
}

void GltfBuffers::hold(uint64_t bytes) {
  writer_.hold(bytes);
  writer_.work(bytes / 16);
}

std::string_view GltfBuffers::decode_data_uri(size_t index) {
  const std::string_view uri = buffers_[index].uri;
  const size_t comma = uri.find(',');
  if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64")) {
    refuse(index, "is not in base64");
  }
  writer_.hold((uri.size() - comma) / 4 * 3);
  std::optional<std::string> bytes = decode_base64(uri.substr(comma + 1));
  if (!bytes) refuse(index, "is malformed");
  return decoded_[index] = std::move(*bytes);
}

std::string_view GltfBuffers::read_beside(size_t index) {
  const std::string relative = unescaped(buffers_[index].uri);
  if (relative.starts_with('/') || relative.find(':') != std::string::npos ||
      relative.find('\0') != std::string::npos) {
    refuse(index, "is not a relative path");
  }
  const std::string& gltf = writer_.name();
  const std::string path = gltf.substr(0, gltf.rfind('/') + 1) + relative;  // npos + 1 is 0
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
  const GltfBuffer& buffer = buffers_[index];
  if (buffer.uri.starts_with("data:")) return decode_data_uri(index);
  if (!buffer.uri.empty()) return read_beside(index);
  // Only the first buffer may be the binary chunk (glTF 2.0, section 4.4.3).
  if (index != 0 || !binary_) refuse(index, "is missing");
  return *binary_;
}

std::string_view GltfBuffers::bytes(size_t index) {
  std::optional<std::string_view>& known = fetched_[index];
  if (known) return *known;
  const std::string_view all = fetch(index);
  const uint64_t declared = buffers_[index].byte_length;
  if (all.size() < declared) {
    refuse(index, "has " + std::to_string(all.size()) + " bytes of the " +
                      std::to_string(declared) + " declared");
  }
  known = all.substr(0, size_t(declared));
  return *known;
}

}  // namespace sobb
