// SPDX-License-Identifier: Apache-2.0
// A scalar closest-hit traversal of a tree of skewed boxes counts its work, for rules that the
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

// A tree with a volume for every child: three slabs of its k-DOP, which its basis selects.
struct BoundedTree {
  const Tree& tree;
  const std::vector<Kdop>& kdops;
  const std::vector<uint16_t>& bases;
  const DirectionTable& directions;
  const MeshSummary& summary;
  const Mesh& mesh;
};

// Clips a child's interval to the ray's own, or also to the part of the ray in the parent.
enum class Clip { kRay, kParent };

// The work per ray, as means over the rays.
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

// WorkCounter counts for a scene's rays again and again. It throws std::logic_error where the hits
// differ from those of the first time: a volume then lost a triangle.
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

// {"nodes", "volumes", "leaves", "triangles"}, per ray.
Json to_json(const Work& work);

}  // namespace sobb::study
