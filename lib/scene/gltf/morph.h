// SPDX-License-Identifier: Apache-2.0
// Applies the default weights of morph targets to positions (specification, section 3.7.2.2).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/gltf/buffers/buffers.h"
#include "scene/gltf/document/model.h"

namespace sobb {

class GltfMorph {
 public:
  // All arguments are borrowed.
  GltfMorph(const GltfDocument& document, GltfBuffers& buffers)
      : document_(document), buffers_(buffers) {}

  // The sum of the targets of `primitive`, each times its weight: x, y, z of each of `count`
  // vertices, good until the next call; empty where no weight is other than zero. Weights beyond
  // the targets are ignored, and those that are missing are zero. Errors: those of
  // GltfAccessor::read().
  std::span<const double> displacements(const tinygltf::Primitive& primitive,
                                        const std::vector<double>& weights, uint64_t count);

 private:
  void add(int accessor, double weight);

  const GltfDocument& document_;
  GltfBuffers& buffers_;
  std::vector<double> sum_;
};

}  // namespace sobb
