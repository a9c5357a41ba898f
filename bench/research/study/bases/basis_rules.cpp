// SPDX-License-Identifier: Apache-2.0
#include "study/bases/basis_rules.h"

#include <algorithm>

#include "base/isa.h"
#include "format/layout.h"

namespace sobb::study {
namespace {

constexpr uint64_t kGrain = 1024;

uint16_t basis_of(const TripleChoice& choice) {
  return make_basis(choice.direction[0], choice.direction[1], choice.direction[2]);
}

}  // namespace

std::string BasisRule::name() const {
  constexpr const char* kFrom[] = {"own", "axes", "average", "sum", "sum or axes"};
  constexpr const char* kStrategy[] = {"", " k", " k2", " k3"};
  std::string name = kFrom[static_cast<size_t>(from)];
  if (from != BasisFrom::kAxes) name += kStrategy[strategy];
  return weighted ? name + " weighted" : name;
}

BasisChooser::BasisChooser(std::span<const Direction> directions, const Tree& tree,
                           const std::vector<Kdop>& kdops, float radius, const Scheduler& scheduler,
                           std::pmr::memory_resource& memory)
    : tree_(tree),
      kdops_(kdops),
      scheduler_(scheduler),
      kernels_(bounds_kernels(resolve_isa(SOBB_ISA_BEST))),
      table_(directions, memory),
      scale_(1 / radius),
      cost_(tree.children.size()) {
  find_costs();
}

// A leaf costs its blocks. A node costs one test, and its children's costs, each times the ratio of
// the child's area to the node's.
void BasisChooser::find_costs() {
  std::vector<float> area(tree_.children.size());
  scheduler_.for_ranges(area.size(), kGrain, [&](uint64_t begin, uint64_t end) {
    for (uint64_t i = begin; i < end; ++i) choose_own(kdops_[i], SOBB_STRATEGY_K2, area[i]);
  });
  for (size_t i = area.size(); i-- > 0;) {
    const Tree::Child& child = tree_.children[i];
    cost_[i] = child.is_leaf() ? static_cast<float>(blocks_of(child.triangles)) : 1;
    if (child.is_leaf() || !(area[i] > 0)) continue;
    const Tree::Node& node = tree_.nodes[child.index];
    for (uint32_t j = node.first_child; j < node.first_child + node.child_count; ++j) {
      cost_[i] += area[j] * cost_[j] / area[i];
    }
  }
}

uint16_t BasisChooser::choose_own(const Kdop& kdop, sobb_strategy strategy, float& area) const {
  alignas(64) float width[kMaxDirections];
  for (uint32_t k = 0; k < kMaxDirections; ++k) {
    width[k] = (kdop.upper[k] - kdop.lower[k]) * scale_;
  }
  const TripleChoice choice = kernels_.choose_one(table_, width, strategy);
  area = choice.area;
  return basis_of(choice);
}

float BasisChooser::weight(uint32_t child, const BasisRule& rule) const {
  return rule.weighted ? cost_[child] : 1;
}

uint16_t BasisChooser::choose_shared(const Tree::Node& node, const BasisRule& rule) const {
  const uint32_t end = node.first_child + node.child_count;
  if (rule.from == BasisFrom::kAxes) return kAxesBasis;
  if (rule.from == BasisFrom::kAverageExtents) {
    alignas(64) float width[kMaxDirections] = {};
    for (uint32_t i = node.first_child; i < end; ++i) {
      for (uint32_t k = 0; k < kMaxDirections; ++k) {
        width[k] += weight(i, rule) * (kdops_[i].upper[k] - kdops_[i].lower[k]) * scale_;
      }
    }
    return basis_of(kernels_.choose_one(table_, width, rule.strategy));
  }
  Gram gram = {};
  for (uint32_t i = node.first_child; i < end; ++i) {
    kernels_.add_to_gram(kdops_[i], scale_, weight(i, rule), gram);
  }
  const BasisChoice choice = kernels_.choose(table_, gram, rule.strategy);
  const bool axes = rule.from == BasisFrom::kSumOrAxes &&
                    !(choice.area < area_in_basis(table_, gram, kAxesBasis));
  return axes ? kAxesBasis : choice.basis;
}

std::vector<uint16_t> BasisChooser::choose(const BasisRule& rule) const {
  std::vector<uint16_t> bases(tree_.children.size());
  scheduler_.for_ranges(tree_.nodes.size(), kGrain, [&](uint64_t begin, uint64_t end) {
    for (uint64_t at = begin; at < end; ++at) {
      const Tree::Node& node = tree_.nodes[at];
      const auto first = bases.begin() + node.first_child;
      if (rule.from != BasisFrom::kEachChild) {
        std::fill_n(first, node.child_count, choose_shared(node, rule));
        continue;
      }
      for (uint32_t i = 0; i < node.child_count; ++i) {
        float area = 0;
        first[i] = choose_own(kdops_[node.first_child + i], rule.strategy, area);
      }
    }
  });
  return bases;
}

}  // namespace sobb::study
