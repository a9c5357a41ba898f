// SPDX-License-Identifier: Apache-2.0
#include "study/bases/counting_trace.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "builder/wide/collapse.h"
#include "format/layout.h"
#include "trace/triangles/closest_hit.h"

namespace sobb::study {
namespace {

constexpr uint64_t kRayGrain = 1024;

// The part of a ray that lies in a volume, as an interval of t.
struct Interval {
  double near;
  double far;
};

// The ray's side of the slab test, by direction. Slabs are widened as in
// trace/nodes/ray_table-inl.h.
class RaySlabs {
 public:
  RaySlabs(const BoundedTree& bounded, const sobb_ray& ray) {
    const MeshSummary& summary = bounded.summary;
    const double origin[3] = {ray.origin[0] - static_cast<double>(summary.centre.x),
                              ray.origin[1] - static_cast<double>(summary.centre.y),
                              ray.origin[2] - static_cast<double>(summary.centre.z)};
    const double distance = std::hypot(origin[0], origin[1], origin[2]);
    const double error = 16 * 0x1p-24 * (2 * distance + summary.radius);
    const double least = kSmallestCosine * std::hypot(static_cast<double>(ray.direction[0]),
                                                      static_cast<double>(ray.direction[1]),
                                                      static_cast<double>(ray.direction[2]));
    const DirectionTable& table = bounded.directions;
    for (uint32_t k = 0; k < table.count; ++k) {
      const double along_origin =
          table.x[k] * origin[0] + table.y[k] * origin[1] + table.z[k] * origin[2];
      const double along = static_cast<double>(table.x[k]) * ray.direction[0] +
                           static_cast<double>(table.y[k]) * ray.direction[1] +
                           static_cast<double>(table.z[k]) * ray.direction[2];
      reciprocal_[k] = 1 / std::copysign(std::max(std::fabs(along), least), along);
      near_[k] = -along_origin * reciprocal_[k] - error * std::fabs(reciprocal_[k]);
      far_[k] = -along_origin * reciprocal_[k] + error * std::fabs(reciprocal_[k]);
    }
  }

  void clip(const Kdop& kdop, uint16_t basis, Interval& interval) const {
    for (int j = 0; j < 3; ++j) {
      const uint32_t k = basis_direction(basis, j);
      const double lower = kdop.lower[k] * reciprocal_[k];
      const double upper = kdop.upper[k] * reciprocal_[k];
      interval.near = std::max(interval.near, std::min(lower, upper) + near_[k]);
      interval.far = std::min(interval.far, std::max(lower, upper) + far_[k]);
    }
  }

 private:
  static constexpr double kSmallestCosine = 0x1p-60;

  double reciprocal_[kMaxDirections];
  double near_[kMaxDirections];
  double far_[kMaxDirections];
};

struct StackEntry {
  const Tree::Child* child;
  Interval interval;
};

class Traversal {
 public:
  Traversal(const BoundedTree& bounded, const sobb_ray& ray, Clip clip, Work& work)
      : bounded_(bounded),
        ray_(ray),
        clip_(clip),
        work_(work),
        slabs_(bounded, ray),
        triangle_ray_(ray),
        best_(ray) {}

  ClosestHit run() {
    visit(bounded_.tree.nodes[0], {ray_.tmin, best_.limit});
    while (top_ != stack_) {
      const StackEntry entry = *--top_;
      if (entry.interval.near > best_.limit) continue;
      if (entry.child->is_leaf()) {
        test(*entry.child);
      } else {
        visit(bounded_.tree.nodes[entry.child->index], entry.interval);
      }
    }
    return best_;
  }

 private:
  // Pushes the children that the ray meets, the nearest last.
  void visit(const Tree::Node& node, const Interval& parent) {
    work_.nodes += 1;
    work_.volumes += node.child_count;
    StackEntry* const base = top_;
    for (uint32_t i = node.first_child; i < node.first_child + node.child_count; ++i) {
      Interval interval = {ray_.tmin, best_.limit};
      if (clip_ == Clip::kParent) {
        interval = {parent.near, std::min<double>(parent.far, best_.limit)};
      }
      slabs_.clip(bounded_.kdops[i], bounded_.bases[i], interval);
      if (interval.near > interval.far) continue;
      StackEntry* at = top_++;
      for (; at != base && at[-1].interval.near < interval.near; --at) *at = at[-1];
      *at = {&bounded_.tree.children[i], interval};
    }
  }

  void test(const Tree::Child& leaf) {
    work_.leaves += 1;
    work_.triangles += leaf.triangles;
    for (uint32_t i = leaf.index; i < leaf.index + leaf.triangles; ++i) {
      const uint32_t primitive = bounded_.tree.primitives[i];
      float vertex[3][3];  // [axis][corner]
      for (int corner = 0; corner < 3; ++corner) {
        const Point p = bounded_.mesh.corner(primitive, corner);
        const float at[3] = {p.x, p.y, p.z};
        for (int k = 0; k < 3; ++k) vertex[k][corner] = at[triangle_ray_.axis[k]];
      }
      TriangleHit hit;
      if (intersect_triangle(triangle_ray_, vertex[0], vertex[1], vertex[2], hit)) {
        best_.offer(hit, ray_.tmin, primitive);
      }
    }
  }

  const BoundedTree& bounded_;
  const sobb_ray& ray_;
  Clip clip_;
  Work& work_;
  RaySlabs slabs_;
  TriangleRay triangle_ray_;
  ClosestHit best_;
  StackEntry stack_[kMaxDepth * (kMaxWidth - 1) + 1];
  StackEntry* top_ = stack_;
};

}  // namespace

Work count_work(const BoundedTree& bounded, std::span<const sobb_ray> rays, Clip clip,
                const Scheduler& scheduler) {
  std::vector<Work> parts((rays.size() + kRayGrain - 1) / kRayGrain);
  scheduler.for_ranges(rays.size(), kRayGrain, [&](uint64_t begin, uint64_t end) {
    Work& part = parts[begin / kRayGrain];
    for (uint64_t i = begin; i < end; ++i) {
      const sobb_hit hit = Traversal(bounded, rays[i], clip, part).run().result();
      if (hit.primitive == SOBB_MISS) continue;
      ++part.hits;
      part.distance += hit.t;
    }
  });
  Work sum;
  for (const Work& part : parts) {
    sum.nodes += part.nodes;
    sum.volumes += part.volumes;
    sum.leaves += part.leaves;
    sum.triangles += part.triangles;
    sum.hits += part.hits;
    sum.distance += part.distance;
  }
  const auto count = static_cast<double>(std::max<size_t>(rays.size(), 1));
  for (double* mean : {&sum.nodes, &sum.volumes, &sum.leaves, &sum.triangles}) *mean /= count;
  return sum;
}

Work WorkCounter::count(const BoundedTree& bounded, Clip clip) {
  const Work work = count_work(bounded, rays_, clip, scheduler_);
  if (!first_) first_ = work;
  if (!work.same_hits(*first_)) throw std::logic_error("a tree's hits differ from another's");
  return work;
}

Json to_json(const Work& work) {
  return {{"nodes", rounded(work.nodes)},
          {"volumes", rounded(work.volumes)},
          {"leaves", rounded(work.leaves)},
          {"triangles", rounded(work.triangles)}};
}

}  // namespace sobb::study
