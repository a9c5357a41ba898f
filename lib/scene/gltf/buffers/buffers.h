// SPDX-License-Identifier: Apache-2.0
// Fetches the bytes of a glTF file's buffers: the binary chunk, data URIs, files beside it; and of
// its buffer views, compressed or not.
//
// The room gltf/buffers/ has where bytes come from: glb.h splits a container, uri.h understands
// what a buffer names, meshopt.h and draco.h decompress.
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
  GltfBuffers(const GltfDocument& document, std::optional<std::string_view> binary,
              SceneWriter& writer);

  // Returns whether an accessor may have that many elements of zeros, which no buffer backs. All
  // accessors together have a limit, since few words must not make many bytes.
  bool take_zeros(uint64_t elements);

  struct View {
    std::string_view bytes;
    uint64_t stride = 0;  // 0 for elements without gaps
  };
  // The bytes of buffer view `index`, decompressed, which live as long as this object. Errors:
  // SCENE_SYNTAX; SCENE_REFERENCE with the URI of a buffer that is missing, or that is shorter than
  // declared and ends before the view; those of decode_meshopt().
  View view(size_t index);

  SceneWriter& writer() { return writer_; }

 private:
  bool has_bytes(int buffer) const;
  std::string_view buffer(size_t index);
  std::string_view part(int buffer, uint64_t offset, uint64_t length, const std::string& place);
  std::string_view decompressed(size_t index, const GltfMeshopt& compressed);
  std::string_view fetch(size_t index);
  std::string_view read_beside(size_t index);
  std::string shortage(size_t index, uint64_t bytes) const;
  [[noreturn]] void refuse(size_t index, const std::string& cause) const;

  const GltfDocument& document_;
  std::optional<std::string_view> binary_;
  SceneWriter& writer_;
  uint64_t zeros_ = 0;
  std::vector<std::optional<std::string_view>> fetched_;
  std::map<size_t, std::string> decoded_;       // data URIs, by buffer
  std::map<size_t, std::string> decompressed_;  // by buffer view
  std::map<std::string, FileBytes> files_;      // by path, since buffers may share one
};

}  // namespace sobb
