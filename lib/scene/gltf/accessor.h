// SPDX-License-Identifier: Apache-2.0
// Reads the elements of a glTF accessor (specification, sections 3.6.2 and 3.6.3).
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "scene/gltf/buffers.h"
#include "scene/gltf/document/model.h"

namespace sobb {

class GltfAccessor {
 public:
  enum class Use { kPositions, kIndices };

  // Proves that every element lies in its buffer, and applies sparse substitution. Errors:
  // SCENE_SYNTAX, SCENE_REFERENCE, MEMORY_LIMIT, CANCELLED. All arguments are borrowed.
  GltfAccessor(const GltfDocument& document, GltfBuffers& buffers, int index, Use use,
               const std::string& name);
  GltfAccessor(const GltfAccessor&) = delete;
  GltfAccessor& operator=(const GltfAccessor&) = delete;

  uint64_t count() const { return count_; }

  // Element i < count() as a position: exact in double, but a normalised integer is rounded once.
  std::array<double, 3> position(uint64_t i) const;
  // Element i < count() as an index.
  uint32_t index(uint64_t i) const;

 private:
  // Elements `stride` bytes apart.
  struct Range {
    const char* data = nullptr;
    uint64_t stride = 0;
  };
  [[noreturn]] void refuse(const char* format, ...) const __attribute__((format(printf, 2, 3)));
  Range range(int index, uint64_t offset, uint64_t count, uint64_t element_size) const;
  void take_type(const tinygltf::Accessor& accessor, Use use);
  void make_dense(const tinygltf::Accessor& accessor);

  const GltfDocument& document_;
  GltfBuffers& buffers_;
  const std::string& name_;
  int index_;
  int component_type_ = 0;
  bool normalized_ = false;
  uint64_t count_ = 0;
  uint64_t element_size_ = 0;
  Range elements_;
  std::string dense_;  // for a sparse accessor or one without a view: elements_ points here
};

}  // namespace sobb
