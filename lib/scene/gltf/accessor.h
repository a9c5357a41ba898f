// SPDX-License-Identifier: Apache-2.0
// The elements of a glTF accessor (specification, sections 3.6.2 and 3.6.3).
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "scene/gltf/buffers.h"
#include "scene/gltf/document.h"

namespace sobb {

class GltfAccessor {
 public:
  enum class Use { kPositions, kIndices };

  // Proves that every element lies in its buffer, and applies sparse substitution. Errors:
  // SCENE_SYNTAX, SCENE_REFERENCE.
  GltfAccessor(const GltfDocument& document, GltfBuffers& buffers, int index, Use use,
               const std::string& name);
  GltfAccessor(const GltfAccessor&) = delete;
  GltfAccessor& operator=(const GltfAccessor&) = delete;

  uint64_t count() const { return count_; }

  // Element i < count(): a position, exact in double (a normalised integer: rounded once).
  std::array<double, 3> position(uint64_t i) const;
  // Element i < count(): an index.
  uint32_t index(uint64_t i) const;

 private:
  struct Range {
    const char* data = nullptr;
    uint64_t stride = 0;
  };
  [[noreturn]] void wrong(const char* format, ...) const __attribute__((format(printf, 2, 3)));
  Range range(int index, uint64_t offset, uint64_t count, uint64_t element) const;
  void check_type(const tinygltf::Accessor& accessor, Use use);
  void substitute(const tinygltf::Accessor& accessor);

  const GltfDocument& document_;
  GltfBuffers& buffers_;
  const std::string& name_;
  int index_;
  int component_type_ = 0;
  bool normalized_ = false;
  uint64_t count_ = 0;
  uint64_t element_ = 0;  // bytes
  Range elements_;
  std::string dense_;  // what elements_ points to, for a sparse accessor or one without a view
};

}  // namespace sobb
