// SPDX-License-Identifier: Apache-2.0
// Reads the elements of a glTF accessor (specification, sections 3.6.2 and 3.6.3).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include "scene/gltf/buffers/buffers.h"
#include "scene/gltf/document/model.h"

namespace sobb {

struct GltfElements {
  uint64_t count = 0;
  int component_type = 0;  // as glTF numbers them
  bool normalized = false;
  uint64_t stride = 0;         // bytes
  const char* data = nullptr;  // null where `owned` has the elements
  std::string owned;
};

class GltfAccessor {
 public:
  enum class Use {
    kPositions,
    kIndices,
    kDisplacements,  // of the positions that are there, and read before the next accessor is made
  };

  // Accessor `index` of the document. Every element is proven to lie in its buffer, and sparse
  // substitution is applied. `expected` is the count of displacements. The document and its buffers
  // outlive the accessor. Errors: SCENE_SYNTAX, SCENE_REFERENCE, MEMORY_LIMIT, CANCELLED.
  static GltfAccessor read(const GltfDocument& document, GltfBuffers& buffers, int index, Use use,
                           uint64_t expected = 0);

  // Elements that need no proof.
  explicit GltfAccessor(GltfElements elements) : elements_(std::move(elements)) {}

  uint64_t count() const { return elements_.count; }

  // Element i < count() as a position: exact in double, but a normalised integer is rounded once.
  std::array<double, 3> position(uint64_t i) const;
  // Element i < count() as an index.
  uint32_t index(uint64_t i) const;

 private:
  const char* element(uint64_t i) const {
    return (elements_.data != nullptr ? elements_.data : elements_.owned.data()) +
           i * elements_.stride;
  }

  GltfElements elements_;
};

}  // namespace sobb
