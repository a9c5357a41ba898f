// SPDX-License-Identifier: Apache-2.0
// Fetches the bytes of a glTF file's buffers: the binary chunk, data URIs, files beside it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf/document/model.h"
#include "scene/input/read_file.h"
#include "scene/model/scene_writer.h"

namespace sobb {

class GltfBuffers {
 public:
  // Reads nothing yet: buffers that no triangle needs may be missing. `binary` is the binary chunk
  // of the glTF file; the writer's name is the file's path. All arguments are borrowed.
  GltfBuffers(const std::vector<GltfBuffer>& buffers, std::optional<std::string_view> binary,
              SceneWriter& writer);

  size_t count() const { return buffers_.size(); }

  // Returns whether an accessor may have that many elements of zeros, which no buffer backs. All
  // accessors together have a limit, since few words must not make many bytes.
  bool take_zeros(uint64_t elements);
  // An accessor holds that many bytes of its own. Errors: MEMORY_LIMIT, CANCELLED.
  void hold(uint64_t bytes);

  // The bytes of buffer `index` < count(), as many as declared. Error SCENE_REFERENCE with the URI
  // where it is missing or shorter.
  std::string_view bytes(size_t index);

 private:
  std::string_view fetch(size_t index);
  std::string_view decode_data_uri(size_t index);
  std::string_view read_beside(size_t index);
  [[noreturn]] void refuse(size_t index, const std::string& cause) const;

  const std::vector<GltfBuffer>& buffers_;
  std::optional<std::string_view> binary_;
  SceneWriter& writer_;
  uint64_t zeros_ = 0;
  std::vector<std::optional<std::string_view>> fetched_;
  std::map<size_t, std::string> decoded_;
  std::map<std::string, FileBytes> files_;  // by path, since buffers may share one
};

}  // namespace sobb
