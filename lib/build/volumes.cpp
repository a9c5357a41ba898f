// SPDX-License-Identifier: Apache-2.0
#include "build/volumes.h"

#include <algorithm>
#include <atomic>
#include <span>
#include <utility>
#include <vector>

#include "build/leaf.h"

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
// Of the table that a ray makes when it first meets other directions. (From 0.92 to 1.63 no scene
// tried is decided otherwise: savings are below a tenth of an average ray's cost, or worth it.)
constexpr float kTableCost = 1.0F;
// As many subtrees, or up to twice as many, tell whether other directions pay.
constexpr size_t kSampledSubtrees = 32;
// The most area that a box in a sphere of radius 1 has: a cube's.
constexpr float kMostSceneArea = 8.0F;

// A child, as its parent sees it.
struct Bounded {
  Kdop kdop;
  float cost = 0;  // of its own test: of its node, or of its blocks
  float area = 0;  // in its own best basis, over the squared scene radius; 0 where not needed
  uint16_t basis = kAxesBasis;  // that one
  // Sums over all nodes from here down: what other directions than the frame's save, cost times
  // area, and the area of the nodes that have them.
  float saved = 0;
  float off_frame = 0;
};

// How the children of a node are bounded.
struct NodeBases {
  uint16_t basis[kMaxWidth];
  bool shared;
  float cost;   // of the node's test
  float saved;  // of cost times area, over all children along the frame
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

  // Makes a part's nodes and blocks, last to first, so that children come before their parent.
  // `bounded` has what is known of the part's nodes' children: by node, and by place for the
  // subtrees below the top. Returns the root's.
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
          make_leaf(references_.part(wide.first[i], wide.count[i]), wide.index[i], leaf[i]);
          child[i] = &leaf[i];
        } else {
          const Bounded* below = subtree_of(static_cast<uint32_t>(at), i);
          child[i] = below != nullptr ? below : &bounded[wide.index[i] - part.first_node];
        }
      }
      nodes[part.first_node + at] = {};
      make_node(wide, child, nodes[part.first_node + at], bounded[at]);
    }
    return bounded[0];
  }

  bool chooses_bases() const { return settings_.volume != SOBB_VOLUME_AABB; }

  // From now on all bases are the frame, the first three directions.
  void keep_to_frame() {
    settings_.volume = SOBB_VOLUME_AABB;
    directions_ = make_direction_table(parts_.directions.first(3));
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

  void make_leaf(const References& leaf, uint32_t block, Bounded& bounded) const {
    const uint64_t block_count = blocks_of(leaf.primitives.size());
    fit_leaf(mesh_, leaf, directions_, parts_.header->centre, kernels_, bounded.kdop, frame_);
    std::fill_n(&parts_.blocks[block], block_count, TriangleBlock{});
    write_blocks(mesh_, leaf.primitives, &parts_.blocks[block]);
    bounded.cost = kBlockCost * static_cast<float>(block_count);
    find_basis(bounded);
  }

  // The best basis of one volume alone.
  void find_basis(Bounded& bounded) const {
    if (!chooses_bases()) return;
    alignas(64) float width[kMaxDirections];
    kernels_.widths(bounded.kdop, scale_, width);
    const TripleChoice choice =
        or_frame(table_, width, kernels_.choose_one(table_, width, settings_.strategy));
    bounded.basis = make_basis(choice.direction[0], choice.direction[1], choice.direction[2]);
    bounded.area = choice.area;
  }

  template <int W>
  void make_node(const WideNode& wide, const Bounded* const* child, Node<W>& node,
                 Bounded& bounded) const {
    // A node has children, which the analyzer cannot know.
    bounded.kdop = child[0]->kdop;  // NOLINT(clang-analyzer-core.NonNullParamChecker)
    for (uint32_t i = 1; i < wide.child_count; ++i) bounded.kdop.merge(child[i]->kdop);
    find_basis(bounded);
    const NodeBases bases = choose_bases(wide.child_count, child, bounded.area);
    bounded.cost = bases.cost;
    bounded.saved = bases.saved;
    bounded.off_frame = bases.cost > kFrameCost ? bounded.area : 0;
    for (uint32_t i = 0; i < wide.child_count; ++i) {
      bounded.saved += child[i]->saved;
      bounded.off_frame += child[i]->off_frame;
    }
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
    bases.saved = axes - std::min({axes, shared, own});
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

// Whether they save more than the tables of the rays that meet such a node, at most all rays that
// meet the scene, cost. By every `stride`-th of the subtrees' roots.
bool other_directions_pay(std::span<const Bounded> roots, size_t stride) {
  float saved = 0;
  float off_frame = 0;
  float sampled = 0;
  for (size_t i = 0; i < roots.size(); i += stride) {
    saved += roots[i].saved;
    off_frame += roots[i].off_frame;
    sampled += 1.0F / static_cast<float>(roots.size());
  }
  return saved >= kTableCost * std::min(off_frame, kMostSceneArea * sampled);
}

template <int W>
void make_volumes_of(VolumeMaker& maker, const WideTopology& wide, const Scheduler& scheduler,
                     Memory& memory, Progress& progress, double progress_begin) {
  const size_t count = wide.subtrees.size();
  std::pmr::vector<Bounded> roots(count, &memory);
  std::atomic<uint64_t> done{0};
  const auto make_subtree = [&](size_t i) {
    const auto none = [](uint32_t, uint32_t) -> const Bounded* { return nullptr; };
    progress.check(progress_begin, 1,
                   std::min(1.0, static_cast<double>(done) / static_cast<double>(count)));
    roots[i] = maker.make_part<W>(wide.subtrees[i], memory, none);
    ++done;
  };
  const bool choosing = maker.chooses_bases();
  const size_t stride = std::max<size_t>(1, count / kSampledSubtrees);
  if (choosing) {
    scheduler.for_each((count + stride - 1) / stride,
                       [&](uint64_t i) { make_subtree(i * stride); });
    if (!other_directions_pay(roots, stride)) maker.keep_to_frame();
  }
  const bool sample_stays = choosing && maker.chooses_bases();
  scheduler.for_each(count, [&](uint64_t i) {
    if (!sample_stays || i % stride != 0) make_subtree(i);
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
