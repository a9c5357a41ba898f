// SPDX-License-Identifier: Apache-2.0
// See morph.h.
#include "scene/gltf/morph.h"

#include <algorithm>

#include "scene/gltf/accessor.h"

namespace sobb {

std::span<const double> GltfMorph::displacements(const tinygltf::Primitive& primitive,
                                                 const std::vector<double>& weights,
                                                 uint64_t count) {
  const size_t targets = std::min(primitive.targets.size(), weights.size());
  const auto moves = [&](size_t target) {
    return weights[target] != 0 && primitive.targets[target].count("POSITION") != 0;
  };
  size_t target = 0;
  while (target < targets && !moves(target)) ++target;
  if (target == targets) return {};
  SceneWriter& writer = buffers_.writer();
  if (3 * count > sum_.capacity()) {
    // The old array is freed first, so that only what is larger is new.
    writer.hold((3 * count - sum_.capacity()) * sizeof(double));
    sum_ = {};
    sum_.reserve(3 * count);
  }
  sum_.assign(3 * count, 0);
  for (; target < targets; ++target) {
    if (moves(target)) add(primitive.targets[target].at("POSITION"), weights[target]);
  }
  return sum_;
}

void GltfMorph::add(int accessor, double weight) {
  const uint64_t count = sum_.size() / 3;
  buffers_.writer().work(count);
  const GltfAccessor target =
      GltfAccessor::read(document_, buffers_, accessor, GltfAccessor::Use::kDisplacements, count);
  for (uint64_t i = 0; i < count; ++i) {
    const std::array<double, 3> displacement = target.position(i);
    for (size_t k = 0; k < 3; ++k) sum_[3 * i + k] += weight * displacement[k];
  }
}

}  // namespace sobb
