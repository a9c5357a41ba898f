// SPDX-License-Identifier: Apache-2.0
// Scalar closest-hit traversal of a tree of skewed boxes that counts its work, for rules that the
// library's kernels do not have.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/scheduler.h"
#include "builder/mesh.h"
#include "sobb/sobb.h"
#include "study/bases/tree.h"
#include "study/report.h"

namespace sobb::study {

// A tree with a volume for every child: the slabs of its k-DOP in its basis.
struct BoundedTree {
  const Tree& tree;
  const std::vector<Kdop>& kdops;
  const std::vector<uint16_t>& bases;
  const DirectionTable& directions;
  const MeshSummary& summary;
  const Mesh& mesh;
};

// What a child's interval is clipped to: the ray's own, or also that in which it is in the parent.
enum class Clip { kRay, kParent };

// Means over the rays.
struct Work {
  double nodes = 0;
  double volumes = 0;
  double leaves = 0;
  double triangles = 0;
  uint64_t hits = 0;
  double distance = 0;  // sum of t over the hits

  bool same_hits(const Work& other) const {
    return hits == other.hits && distance == other.distance;
  }
};

Work count_work(const BoundedTree& bounded, std::span<const sobb_ray> rays, Clip clip,
                const Scheduler& scheduler);

// The same for a scene's rays again and again. Throws std::logic_error where the hits are not those
// of the first time: a volume then lost a triangle.
class WorkCounter {
 public:
  WorkCounter(std::span<const sobb_ray> rays, const Scheduler& scheduler)
      : rays_(rays), scheduler_(scheduler) {}

  Work count(const BoundedTree& bounded, Clip clip = Clip::kRay);

 private:
  std::span<const sobb_ray> rays_;
  const Scheduler& scheduler_;
  std::optional<Work> first_;
};

// {"nodes", "volumes", "leaves", "triangles"}, a ray.
Json to_json(const Work& work);

}  // namespace sobb::study
