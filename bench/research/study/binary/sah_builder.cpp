// SPDX-License-Identifier: Apache-2.0
#include "study/binary/sah_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/binary/fibre_split.h"
#include "study/binary/sah_costs.h"

namespace sobb::study {
namespace {

constexpr int kBins = 32;
// Below this depth references are halved in their order, since coincident centroids and rows of
// ever smaller triangles would pass the file's limit of depth.
constexpr uint32_t kDeepest = kMaxDepth - 32;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Kdop nothing() {
  Kdop kdop;
  std::fill(kdop.lower, kdop.lower + kMaxDirections, kInfinity);
  std::fill(kdop.upper, kdop.upper + kMaxDirections, -kInfinity);
  return kdop;
}

// Twice the centre of a slab. The scale of the bins has the same factor.
float place(const Kdop& kdop, uint32_t direction) {
  return kdop.lower[direction] + kdop.upper[direction];
}

int bin_of(float place, float begin, float scale) {
  return std::min(static_cast<int>((place - begin) * scale), kBins - 1);
}

}  // namespace

struct SahBuilder::Split {
  float cost = kInfinity;  // sum over the sides of area times the cost of their triangles
  uint32_t direction = 0;  // along which centroids are binned
  float begin = 0;
  float scale = 0;
  int bin = 0;                       // first bin of the second side
  std::optional<FibreSplit> fibres;  // instead of bins
};

bool SahBuilder::is_second(const Split& split, const Reference& reference) const {
  if (split.fibres) return split.fibres->is_second(tangents_[reference.primitive]);
  return bin_of(place(measure_.kdop(reference), split.direction), split.begin, split.scale) >=
         split.bin;
}

void SahBuilder::try_direction(std::span<const Reference> references, uint32_t direction,
                               float begin, float scale, Split& best) const {
  Kdop bins[kBins];
  uint32_t counts[kBins] = {};
  std::fill(bins, bins + kBins, nothing());
  for (const Reference& reference : references) {
    const Kdop& kdop = measure_.kdop(reference);
    const int bin = bin_of(place(kdop, direction), begin, scale);
    bins[bin].merge(kdop);
    ++counts[bin];
  }

  float second_cost[kBins];  // of the bins from here on
  Kdop kdop = nothing();
  uint32_t count = 0;
  for (int bin = kBins - 1; bin > 0; --bin) {
    if (counts[bin] > 0) {
      kdop.merge(bins[bin]);
      count += counts[bin];
      second_cost[bin] = measure_.area(settings_.volume, kdop) * triangles_cost(count);
    } else {
      second_cost[bin] = bin + 1 < kBins ? second_cost[bin + 1] : 0;
    }
  }
  kdop = nothing();
  count = 0;
  for (int bin = 1; bin < kBins; ++bin) {
    if (counts[bin - 1] == 0) continue;
    kdop.merge(bins[bin - 1]);
    count += counts[bin - 1];
    if (count == references.size()) return;
    if (second_cost[bin] >= best.cost) continue;
    const float first_cost = measure_.area(settings_.volume, kdop) * triangles_cost(count);
    if (first_cost + second_cost[bin] < best.cost) {
      best = {first_cost + second_cost[bin], direction, begin, scale, bin, std::nullopt};
    }
  }
}

void SahBuilder::try_fibres(std::span<const Reference> references, Split& best) const {
  const auto fibres = split_fibres(references, tangents_);
  if (!fibres) return;
  Kdop kdop[2] = {nothing(), nothing()};
  uint32_t count[2] = {};
  for (const Reference& reference : references) {
    const bool second = fibres->is_second(tangents_[reference.primitive]);
    kdop[second].merge(measure_.kdop(reference));
    ++count[second];
  }
  if (count[0] == 0 || count[1] == 0) return;
  const float cost = measure_.area(settings_.volume, kdop[0]) * triangles_cost(count[0]) +
                     measure_.area(settings_.volume, kdop[1]) * triangles_cost(count[1]);
  if (cost < best.cost) best = {cost, 0, 0, 0, 0, fibres};
}

SahBuilder::Split SahBuilder::find(std::span<const Reference> references) const {
  Split best;
  for (uint32_t direction = 0; direction < settings_.directions; ++direction) {
    float begin = kInfinity;
    float end = -kInfinity;
    for (const Reference& reference : references) {
      const float at = place(measure_.kdop(reference), direction);
      begin = std::min(begin, at);
      end = std::max(end, at);
    }
    const float scale = static_cast<float>(kBins) / (end - begin);
    if (std::isfinite(scale)) try_direction(references, direction, begin, scale, best);
  }
  if (settings_.fibres) try_fibres(references, best);
  return best;
}

uint32_t SahBuilder::add(BinaryTree& tree, uint32_t first, uint32_t count, uint32_t depth) const {
  const auto at = static_cast<uint32_t>(tree.nodes.size());
  tree.nodes.push_back({{0, 0}, first, count});
  if (count == 1) return at;
  const std::span<Reference> references(tree.references.data() + first, count);
  const Split split = depth < kDeepest ? find(references) : Split();
  if (count <= settings_.leaf_limit) {
    Kdop kdop = nothing();
    for (const Reference& reference : references) kdop.merge(measure_.kdop(reference));
    const float area = measure_.area(settings_.volume, kdop);
    if (area * triangles_cost(count) <= kStepCost * area + split.cost) return at;
  }
  uint32_t first_count = count / 2;
  if (split.cost < kInfinity) {
    const auto middle = std::stable_partition(
        references.begin(), references.end(),
        [&](const Reference& reference) { return !is_second(split, reference); });
    first_count = static_cast<uint32_t>(middle - references.begin());
  }
  const uint32_t child = add(tree, first, first_count, depth + 1);
  const uint32_t other = add(tree, first + first_count, count - first_count, depth + 1);
  tree.nodes[at].child[0] = child;
  tree.nodes[at].child[1] = other;
  return at;
}

void SahBuilder::build(BinaryTree& tree) const {
  tree.nodes.clear();
  add(tree, 0, static_cast<uint32_t>(tree.references.size()), 1);
}

uint32_t SahBuilder::copy(const BinaryTree& from, uint32_t node, BinaryTree& tree,
                          uint32_t depth) const {
  const BinaryNode& source = from.nodes[node];
  if (source.is_leaf()) return add(tree, source.first, source.count, depth);
  const auto at = static_cast<uint32_t>(tree.nodes.size());
  tree.nodes.push_back(source);
  for (int i = 0; i < 2; ++i) {
    const uint32_t child = copy(from, source.child[i], tree, depth + 1);
    tree.nodes[at].child[i] = child;
  }
  return at;
}

BinaryTree SahBuilder::split_leaves(const BinaryTree& tree) const {
  BinaryTree result{tree.references, {}};
  copy(tree, 0, result, 1);
  return result;
}

}  // namespace sobb::study
