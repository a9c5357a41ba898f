// SPDX-License-Identifier: Apache-2.0
// The bytes of a glTF file's buffers: the binary chunk, data URIs, files beside it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf/document.h"
#include "scene/input/read_file.h"
#include "scene/scene_writer.h"

namespace sobb {

class GltfBuffers {
 public:
  // Reads nothing yet: buffers that no triangle needs may be missing. `path` is the glTF file's,
  // `binary` its binary chunk. All arguments are borrowed.
  GltfBuffers(const std::vector<GltfBuffer>& buffers, std::string_view path,
              std::optional<std::string_view> binary, SceneWriter& writer);

  size_t count() const { return buffers_.size(); }

  // Whether an accessor may have so many zeros that no buffer backs: few words must not make many
  // bytes.
  bool take_zeros(uint64_t elements);
  // An accessor holds bytes of its own. Error MEMORY_LIMIT.
  void hold(uint64_t bytes);

  // The bytes of buffer `index` < count(), as many as declared. Error SCENE_REFERENCE with the URI
  // where it is missing or shorter.
  std::string_view bytes(size_t index);

 private:
  std::string_view fetch(size_t index);
  std::string_view decoded(size_t index);
  std::string_view file(size_t index);
  [[noreturn]] void refuse(size_t index, const std::string& cause) const;

  const std::vector<GltfBuffer>& buffers_;
  std::string_view path_;
  std::optional<std::string_view> binary_;
  SceneWriter& writer_;
  uint64_t zeros_ = 0;
  std::vector<std::optional<std::string_view>> fetched_;
  std::map<size_t, std::string> decoded_;
  std::map<std::string, FileBytes> files_;  // by path, since buffers may share one
};

}  // namespace sobb
