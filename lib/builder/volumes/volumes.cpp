// SPDX-License-Identifier: Apache-2.0
#include "builder/volumes/volumes.h"

#include <optional>

#include "builder/volumes/basis_savings.h"
#include "builder/volumes/node_writer.h"
#include "builder/wide/bottom_up.h"

namespace sobb {
namespace {

// The bottom-up walk's visitor: bounds leaves and nodes, and writes them.
template <int W>
class NodeMaker {
 public:
  using Value = BoundedChild;

  NodeMaker(const Mesh& mesh, const References& references, const NodeBounder& bounder,
            const NodeOutput& output)
      : mesh_(mesh),
        references_(references),
        bounder_(bounder),
        nodes_(static_cast<Node<W>*>(output.nodes)),
        blocks_(output.blocks) {}

  // A leaf's triangles lie anywhere in the mesh. The corners of the next node's triangles and the
  // indices of those of the node after are read ahead, so that the waits for memory overlap.
  void prefetch(const Treelet& treelet, size_t at) const {
    if (at >= 1) {
      for_each_triangle(treelet.nodes[at - 1], [&](uint32_t i) { mesh_.touch_corners(i); });
    }
    if (at >= 2) {
      for_each_triangle(treelet.nodes[at - 2], [&](uint32_t i) { mesh_.touch_indices(i); });
    }
  }

  void visit_leaf(const WideNode& wide, uint32_t i, BoundedChild& bounded) const {
    const References leaf = references_.part(wide.first[i], wide.count[i]);
    bounder_.bound_leaf(leaf, bounded);
    write_blocks(mesh_, leaf.primitives, &blocks_[wide.index[i]]);
  }

  void visit_node(uint64_t index, const WideNode& wide, const BoundedChild* const* child,
                  BoundedChild& bounded) const {
    const NodeBases bases = bounder_.bound_node(wide.child_count, child, bounded);
    write_node(wide, child, bases, nodes_[index]);
  }

 private:
  // Calls visit(triangle) for the leaves that are the node's children.
  template <class Visit>
  void for_each_triangle(const WideNode& wide, const Visit& visit) const {
    for (uint32_t i = 0; i < wide.child_count; ++i) {
      for (uint32_t j = 0; j < wide.count[i]; ++j) visit(references_.primitives[wide.first[i] + j]);
    }
  }

  const Mesh& mesh_;
  const References& references_;
  const NodeBounder& bounder_;
  Node<W>* nodes_;
  std::span<TriangleBlock> blocks_;
};

template <class Visitor>
void visit_all(const Visitor& visitor, const WideTopology& wide, const Scheduler& scheduler,
               Memory& memory, Progress& progress, double progress_begin) {
  const auto report = [&](double fraction) { progress.check(progress_begin, 1, fraction); };
  const auto roots = walk_subtrees(wide, visitor, scheduler, memory, report);
  walk_top(wide, visitor, memory, roots);
  progress.check(progress_begin, 1, 1);
}

}  // namespace

void make_volumes(const VolumeScene& scene, const WideTopology& wide,
                  const VolumeSettings& settings, const NodeOutput& output,
                  const Scheduler& scheduler, Memory& memory, Progress& progress,
                  double progress_begin) {
  const BoundsKernels& kernels = bounds_kernels(settings.isa);
  std::optional<NodeBounder> bounder;
  if (settings.volume != SOBB_VOLUME_AABB) {
    bounder.emplace(scene, settings.strategy, kernels, memory);
    if (!other_directions_pay(*bounder, wide, scheduler, memory)) bounder.reset();
  }
  if (!bounder) bounder.emplace(scene, std::nullopt, kernels, memory);
  if (output.width == 4) {
    visit_all(NodeMaker<4>(scene.mesh, wide.references, *bounder, output), wide, scheduler, memory,
              progress, progress_begin);
  } else {
    visit_all(NodeMaker<8>(scene.mesh, wide.references, *bounder, output), wide, scheduler, memory,
              progress, progress_begin);
  }
}

}  // namespace sobb
