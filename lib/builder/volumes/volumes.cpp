// SPDX-License-Identifier: Apache-2.0
#include "builder/volumes/volumes.h"

#include <algorithm>
#include <atomic>
#include <span>
#include <utility>
#include <vector>

#include "builder/volumes/leaf.h"

namespace sobb {
namespace {

// What a ray pays, in units of a node test along the frame. Other directions must be looked up, or
// made; then a basis for each child costs little more than a shared one. (Measured by rays a second
// of hair, hairball, pipes, leaves and crown, single rays and batches: shared at 1 loses up to 6 %
// to AABBs on the last two, own at 2.6 up to 5 % on hairball.)
constexpr float kFrameCost = 1.0F;
constexpr float kSharedCost = 1.8F;
constexpr float kOwnCost = 2.0F;
constexpr float kBlockCost = 1.0F;
// Of the table that a ray makes when it first meets other directions. (From 0.7 to 1.2 no scene
// tried is decided otherwise.)
constexpr float kTableCost = 1.0F;
// Beyond that, other directions must save this share of what nodes cost: less is not worth the time
// to choose them, a tenth to a quarter of a build. (Crown saves 0.1 %, a robot 4 %.)
constexpr float kLeastShare = 0.02F;
// What they save is told by some so many nodes, in subtrees of at most so many.
constexpr uint64_t kSampledNodes = 2048;
constexpr uint32_t kSmallSubtree = 8;
// The most area that a box in a sphere of radius 1 has: a cube's.
constexpr float kMostSceneArea = 8.0F;

// A child, as its parent sees it.
struct Bounded {
  Kdop kdop;
  float cost = 0;  // of its own test: of its node, or of its blocks
  float area = 0;  // in its own best basis, over the squared scene radius; 0 where not needed
  uint16_t basis = kAxesBasis;  // that one
};

// How the children of a node are bounded.
struct NodeBases {
  uint16_t basis[kMaxWidth];
  bool shared;
  float cost;  // of the node's test
  // Cost times area of node and children, and with all of them along the frame.
  float chosen;
  float along_frame;
};

// What other directions than the frame's bring some nodes, cost times area.
struct Saving {
  float along_frame = 0;  // what the nodes and their children cost without
  float saved = 0;
  float off_frame = 0;  // the area of the nodes that have others

  void add(const Saving& other) {
    along_frame += other.along_frame;
    saved += other.saved;
    off_frame += other.off_frame;
  }
};

class VolumeMaker {
 public:
  VolumeMaker(const Mesh& mesh, const References& references, const VolumeSettings& settings,
              const ImageParts& parts, std::pmr::memory_resource& memory)
      : mesh_(mesh),
        references_(references),
        settings_(settings),
        parts_(parts),
        kernels_(bounds_kernels(settings.isa)),
        directions_(make_direction_table(parts.directions)),
        frame_(parts.directions,
               {parts.header->centre[0], parts.header->centre[1], parts.header->centre[2]}),
        table_(parts.directions, memory),
        scale_(parts.header->radius > 0 ? 1 / parts.header->radius : 1) {}

  bool chooses_bases() const { return settings_.volume != SOBB_VOLUME_AABB; }

  // From now on all bases are the frame, the first three directions.
  void keep_to_frame() {
    settings_.volume = SOBB_VOLUME_AABB;
    directions_ = make_direction_table(parts_.directions.first(3));
  }

  // Looks at every `stride`-th of a part's small subtrees, from the `skipped`-th on. Not of the
  // top, where there are subtrees below it.
  Saving look_at(const Part& part, uint64_t stride, uint64_t skipped,
                 std::pmr::memory_resource& memory) const {
    std::pmr::vector<uint32_t> size(part.nodes.size(), 1, &memory);  // nodes from there down
    for (size_t at = part.nodes.size(); at-- > 0;) {
      for_each_inner(part, at, [&](size_t child) { size[at] += size[child]; });
    }
    Saving saving;
    const auto look_if = [&](size_t at) {
      if (size[at] > kSmallSubtree || skipped++ % stride != 0) return;
      Bounded root;
      look_below(part, at, root, saving);
    };
    look_if(0);
    for (size_t at = 0; at < part.nodes.size(); ++at) {
      if (size[at] > kSmallSubtree) for_each_inner(part, at, look_if);
    }
    return saving;
  }

  // Makes a part's nodes and blocks, last to first, so that children come before their parent.
  // subtree_of(node, child) is what is known of a subtree below the top, null for a child within
  // the part. Returns the root's.
  template <int W, class ChildOf>
  Bounded make_part(const Part& part, std::pmr::memory_resource& memory,
                    const ChildOf& subtree_of) const {
    std::pmr::vector<Bounded> bounded(part.nodes.size(), &memory);
    auto* nodes = static_cast<Node<W>*>(parts_.nodes);
    for (size_t at = part.nodes.size(); at-- > 0;) {
      touch_next(part, at);
      const WideNode& wide = part.nodes[at];
      Bounded leaf[kMaxWidth];
      const Bounded* child[kMaxWidth] = {};
      for (uint32_t i = 0; i < wide.child_count; ++i) {
        if (wide.is_leaf(i)) {
          const References references = references_.part(wide.first[i], wide.count[i]);
          bound_leaf(references, leaf[i]);
          fill_blocks(references, wide.index[i]);
          child[i] = &leaf[i];
        } else {
          const Bounded* below = subtree_of(static_cast<uint32_t>(at), i);
          child[i] = below != nullptr ? below : &bounded[wide.index[i] - part.first_node];
        }
      }
      const NodeBases bases = bound_node(wide.child_count, child, bounded[at]);
      nodes[part.first_node + at] = {};
      fill_node(wide, child, bases, nodes[part.first_node + at]);
    }
    return bounded[0];
  }

 private:
  // A leaf's triangles lie anywhere in the mesh. The corners of those of the next node and the
  // indices of the one after are read ahead, so that the waits for memory overlap.
  void touch_next(const Part& part, size_t at) const {
    if (at >= 1) {
      for_each_triangle(part.nodes[at - 1], [&](uint32_t i) { mesh_.touch_corners(i); });
    }
    if (at >= 2) {
      for_each_triangle(part.nodes[at - 2], [&](uint32_t i) { mesh_.touch_indices(i); });
    }
  }

  // Of the leaves that are the node's children.
  template <class Body>
  void for_each_triangle(const WideNode& wide, const Body& body) const {
    for (uint32_t i = 0; i < wide.child_count; ++i) {
      for (uint32_t j = 0; j < wide.count[i]; ++j) body(references_.primitives[wide.first[i] + j]);
    }
  }

  // Of the node's inner children, in the part.
  template <class Body>
  static void for_each_inner(const Part& part, size_t at, const Body& body) {
    const WideNode& wide = part.nodes[at];
    for (uint32_t i = 0; i < wide.child_count; ++i) {
      if (!wide.is_leaf(i)) body(static_cast<size_t>(wide.index[i] - part.first_node));
    }
  }

  // Adds up what a node and those below would save.
  void look_below(const Part& part, size_t at, Bounded& node, Saving& saving) const {
    const WideNode& wide = part.nodes[at];
    Bounded below[kMaxWidth];
    const Bounded* child[kMaxWidth] = {};
    for (uint32_t i = 0; i < wide.child_count; ++i) {
      if (wide.is_leaf(i)) {
        bound_leaf(references_.part(wide.first[i], wide.count[i]), below[i]);
      } else {
        look_below(part, wide.index[i] - part.first_node, below[i], saving);
      }
      child[i] = &below[i];
    }
    const NodeBases bases = bound_node(wide.child_count, child, node);
    saving.along_frame += bases.along_frame;
    saving.saved += bases.along_frame - bases.chosen;
    saving.off_frame += bases.cost > kFrameCost ? node.area : 0;
  }

  void bound_leaf(const References& leaf, Bounded& bounded) const {
    fit_leaf(mesh_, leaf, directions_, parts_.header->centre, kernels_, bounded.kdop, frame_);
    bounded.cost = kBlockCost * static_cast<float>(blocks_of(leaf.primitives.size()));
    if (chooses_bases()) find_basis(bounded);
  }

  void fill_blocks(const References& leaf, uint32_t block) const {
    std::fill_n(&parts_.blocks[block], blocks_of(leaf.primitives.size()), TriangleBlock{});
    write_blocks(mesh_, leaf.primitives, &parts_.blocks[block]);
  }

  // The best basis of one volume alone.
  void find_basis(Bounded& bounded) const {
    alignas(64) float width[kMaxDirections];
    kernels_.widths(bounded.kdop, scale_, width);
    const TripleChoice choice =
        or_frame(table_, width, kernels_.choose_one(table_, width, settings_.strategy));
    bounded.basis = make_basis(choice.direction[0], choice.direction[1], choice.direction[2]);
    bounded.area = choice.area;
  }

  NodeBases bound_node(uint32_t count, const Bounded* const* child, Bounded& bounded) const {
    // A node has children, which the analyzer cannot know.
    bounded.kdop = child[0]->kdop;  // NOLINT(clang-analyzer-core.NonNullParamChecker)
    for (uint32_t i = 1; i < count; ++i) bounded.kdop.merge(child[i]->kdop);
    if (chooses_bases()) find_basis(bounded);
    const NodeBases bases = choose_bases(count, child, bounded.area);
    bounded.cost = bases.cost;
    return bases;
  }

  template <int W>
  static void fill_node(const WideNode& wide, const Bounded* const* child, const NodeBases& bases,
                        Node<W>& node) {
    for (uint32_t i = 0; i < wide.child_count; ++i) {
      for (int j = 0; j < 3; ++j) {
        const uint32_t direction = basis_direction(bases.basis[i], j);
        node.slab[j][0][i] = child[i]->kdop.lower[direction];
        node.slab[j][1][i] = child[i]->kdop.upper[direction];
      }
      node.reference[i] = wide.index[i];
      node.basis[i] = bases.basis[i];
      if (wide.is_leaf(i)) node.meta[i] = static_cast<uint16_t>(kLeafBit | wide.count[i]);
    }
    node.meta[0] |= static_cast<uint16_t>(wide.child_count << kChildCountShift);
    if (bases.shared) node.meta[0] |= kSharedBit;
  }

  // The shared basis is that of the least sum of areas. (Of the least sum of costs, rays test some
  // more triangles: docs/study.md.) The surface area heuristic decides between it, the axes for all
  // children, and a basis for each child: area(node) * cost(test) + sum area(child) * cost(child).
  // What lies below the children is met as often whatever bounds them, so only their own tests
  // count.
  NodeBases choose_bases(uint32_t count, const Bounded* const* child, float node_area) const {
    NodeBases bases{};
    std::fill(bases.basis, bases.basis + count, kAxesBasis);
    bases.shared = true;
    bases.cost = kFrameCost;
    if (!chooses_bases()) return bases;
    Gram gram = {};
    float own = 0;
    for (uint32_t i = 0; i < count; ++i) {
      kernels_.add_to_gram(child[i]->kdop, scale_, 1, gram);
      own += child[i]->area * child[i]->cost;
    }
    const uint16_t least = kernels_.choose(table_, gram, settings_.strategy).basis;
    const float axes = kFrameCost * node_area + cost_below(count, child, kAxesBasis);
    const float shared = kSharedCost * node_area + cost_below(count, child, least);
    own += kOwnCost * node_area;
    bases.along_frame = axes;
    bases.chosen = std::min({axes, shared, own});
    if (own < std::min(axes, shared)) {
      for (uint32_t i = 0; i < count; ++i) bases.basis[i] = child[i]->basis;
      bases.shared = false;
      bases.cost = kOwnCost;
    } else if (shared < axes) {
      std::fill(bases.basis, bases.basis + count, least);
      bases.cost = kSharedCost;
    }
    return bases;
  }

  // sum area(child) * cost(child), all in one basis: 2 (d0 d1 + d1 d2 + d2 d0) / |det| each.
  float cost_below(uint32_t count, const Bounded* const* child, uint16_t basis) const {
    const uint32_t k[3] = {basis_direction(basis, 0), basis_direction(basis, 1),
                           basis_direction(basis, 2)};
    float sum = 0;
    for (uint32_t i = 0; i < count; ++i) {
      float d[3];
      for (int j = 0; j < 3; ++j) {
        d[j] = (child[i]->kdop.upper[k[j]] - child[i]->kdop.lower[k[j]]) * scale_;
      }
      sum += (d[0] * d[1] + d[1] * d[2] + d[2] * d[0]) * child[i]->cost;
    }
    return 2 * sum * table_.inverse_determinants(k[0], k[1])[k[2]];
  }

  const Mesh& mesh_;
  References references_;
  VolumeSettings settings_;
  ImageParts parts_;
  const BoundsKernels& kernels_;
  DirectionTable directions_;
  Frame frame_;  // the topology's
  BasisTable table_;
  float scale_;  // of widths, so that areas neither overflow nor vanish
};

// Whether other directions than the frame's save enough, beyond what the tables cost of the rays
// that meet such a node: at most all rays that meet the scene.
bool other_directions_pay(const VolumeMaker& maker, const WideTopology& wide,
                          const Scheduler& scheduler, std::pmr::memory_resource& memory) {
  const std::span<const Part> parts =
      wide.subtrees.empty() ? std::span(&wide.top, 1) : std::span(wide.subtrees);
  const uint64_t stride = std::max<uint64_t>(1, wide.node_count / kSampledNodes);
  std::pmr::vector<Saving> savings(parts.size(), &memory);
  scheduler.for_each(parts.size(),
                     [&](uint64_t i) { savings[i] = maker.look_at(parts[i], stride, i, memory); });
  Saving all;
  for (const Saving& saving : savings) all.add(saving);
  const float sampled = 1 / static_cast<float>(stride);
  const float tables = kTableCost * std::min(all.off_frame, kMostSceneArea * sampled);
  return all.saved - tables >= kLeastShare * all.along_frame;
}

template <int W>
void make_volumes_of(VolumeMaker& maker, const WideTopology& wide, const Scheduler& scheduler,
                     Memory& memory, Progress& progress, double progress_begin) {
  if (maker.chooses_bases() && !other_directions_pay(maker, wide, scheduler, memory)) {
    maker.keep_to_frame();
  }
  const size_t count = wide.subtrees.size();
  std::pmr::vector<Bounded> roots(count, &memory);
  std::atomic<uint64_t> done{0};
  scheduler.for_each(count, [&](uint64_t i) {
    const auto none = [](uint32_t, uint32_t) -> const Bounded* { return nullptr; };
    progress.check(progress_begin, 1, static_cast<double>(done) / static_cast<double>(count));
    roots[i] = maker.make_part<W>(wide.subtrees[i], memory, none);
    ++done;
  });
  // Places are in the order of the top's nodes and their children.
  const auto subtree = [&](uint32_t node, uint32_t child) -> const Bounded* {
    const auto at = std::lower_bound(
        wide.places.begin(), wide.places.end(), std::pair(node, child),
        [](const WideTopology::Place& place, const std::pair<uint32_t, uint32_t>& wanted) {
          return std::pair(place.node, place.child) < wanted;
        });
    const bool found = at != wide.places.end() && at->node == node && at->child == child;
    return found ? &roots[static_cast<size_t>(at - wide.places.begin())] : nullptr;
  };
  maker.make_part<W>(wide.top, memory, subtree);
  progress.check(progress_begin, 1, 1);
}

}  // namespace

void make_volumes(const Mesh& mesh, const WideTopology& wide, const VolumeSettings& settings,
                  const ImageParts& parts, const Scheduler& scheduler, Memory& memory,
                  Progress& progress, double progress_begin) {
  VolumeMaker maker(mesh, wide.references, settings, parts, memory);
  if (parts.header->width == 4) {
    make_volumes_of<4>(maker, wide, scheduler, memory, progress, progress_begin);
  } else {
    make_volumes_of<8>(maker, wide, scheduler, memory, progress, progress_begin);
  }
}

}  // namespace sobb
