// SPDX-License-Identifier: Apache-2.0
#include "study/questions/topology_variants.h"

#include <utility>

#include "stopwatch.h"
#include "study/binary/embree_tree.h"
#include "study/binary/fibre_split.h"
#include "study/binary/leaf_choice.h"
#include "study/binary/sah_builder.h"
#include "study/wide/exact_collapse.h"
#include "study/wide/greedy_collapse.h"
#include "study/wide/shared_collapse.h"

namespace sobb::study {
namespace {

constexpr uint32_t kWidth = 8;

class Variants {
 public:
  Variants(const Mesh& mesh, const MeshSummary& summary, std::pmr::memory_resource& memory,
           const std::function<void(const Variant&)>& visit)
      : mesh_(mesh),
        measure_(mesh, summary, memory),
        tangents_(fibre_tangents(mesh)),
        visit_(visit) {}

  void visit_all() {
    const SahSettings by_aabb{SOBB_VOLUME_AABB};
    const SahSettings by_sobb{SOBB_VOLUME_SOBB};
    const uint32_t all = measure_.direction_count();

#ifdef SOBB_EMBREE_MAJOR
    visit_embree();
#endif
    built("aabb", by_aabb);
    built("sobb", by_sobb);
    built("sobb-all-directions", {SOBB_VOLUME_SOBB, all});
    built("sobb-fibres", {SOBB_VOLUME_SOBB, 3, true});
    const auto finest = timed([&] { return build({SOBB_VOLUME_SOBB, all, true, 1}); });
    sharing("sobb-all-directions-fibres", "sobb", finest, Leaves::kChosen);
  }

 private:
  struct Timed {
    BinaryTree tree;
    double ms;
  };

  template <class Work>
  static Timed timed(const Work& work) {
    Timed result;
    result.ms = 1e3 * bench::Stopwatch(1).seconds_of([&] { result.tree = work(); });
    return result;
  }

#ifdef SOBB_EMBREE_MAJOR
  void visit_embree() {
    const auto embree = timed([&] { return embree_tree(mesh_); });
    binary("embree", "embree", embree);
    wide("embree", "embree", embree, SOBB_VOLUME_AABB);
    wide("embree", "embree", embree, SOBB_VOLUME_SOBB);
    exact("embree", "embree", embree, SOBB_VOLUME_AABB, Leaves::kKept);
    exact("embree", "embree", embree, SOBB_VOLUME_SOBB, Leaves::kKept);
    sharing("embree", "embree", embree, Leaves::kKept);

    auto fine = timed([&] {
      return SahBuilder(measure_, tangents_, {SOBB_VOLUME_AABB, 3, false, 1})
          .split_leaves(embree.tree);
    });
    fine.ms += embree.ms;
    chosen_leaves("embree", fine, SOBB_VOLUME_AABB);
    chosen_leaves("embree", fine, SOBB_VOLUME_SOBB);
    exact("embree", "aabb", fine, SOBB_VOLUME_AABB, Leaves::kChosen);
    exact("embree", "sobb", fine, SOBB_VOLUME_SOBB, Leaves::kChosen);
    sharing("embree", "sobb", fine, Leaves::kChosen);
  }
#endif

  BinaryTree build(const SahSettings& settings) const {
    BinaryTree tree;
    for (uint32_t i = 0; i < mesh_.triangle_count(); ++i) {
      tree.references.push_back({i});
    }
    SahBuilder(measure_, tangents_, settings).build(tree);
    return tree;
  }

  static const char* name_of(sobb_volume volume) {
    return volume == SOBB_VOLUME_AABB ? "aabb" : "sobb";
  }

  // A binary hierarchy consists of wide nodes of two children.
  void binary(const char* splits, const char* leaves, const Timed& from) const {
    const std::vector<float> none(from.tree.nodes.size());
    visit_({splits, leaves, "none", Layout::kBinary, from.tree,
            collapse_greedily(from.tree, none, 2), from.ms, 0});
  }

  void wide(const char* splits, const char* leaves, const Timed& from, sobb_volume volume) const {
    collapsed(
        splits, leaves, volume == SOBB_VOLUME_AABB ? "greedy-aabb" : "greedy-sobb", from,
        [&] { return collapse_greedily(from.tree, measure_.areas(volume, from.tree), kWidth); });
  }

  void exact(const char* splits, const char* leaves_name, const Timed& from, sobb_volume volume,
             Leaves leaves) const {
    collapsed(
        splits, leaves_name, volume == SOBB_VOLUME_AABB ? "exact-aabb" : "exact-sobb", from, [&] {
          return collapse_exactly(from.tree, measure_.areas(volume, from.tree), kWidth, leaves);
        });
  }

  void sharing(const char* splits, const char* leaves_name, const Timed& from,
               Leaves leaves) const {
    collapsed(splits, leaves_name, "exact-sharing", from,
              [&] { return collapse_sharing(from.tree, measure_, leaves); });
  }

  template <class Cut>
  void collapsed(const char* splits, const char* leaves, const char* collapse, const Timed& from,
                 const Cut& make_cut) const {
    WideCut cut;
    const double seconds = bench::Stopwatch(1).seconds_of([&] { cut = make_cut(); });
    visit_({splits, leaves, collapse, Layout::kWide, from.tree, std::move(cut), from.ms,
            1e3 * seconds});
  }

  void chosen_leaves(const char* splits, const Timed& from, sobb_volume volume) const {
    auto chosen =
        timed([&] { return choose_leaves(from.tree, measure_.areas(volume, from.tree)); });
    chosen.ms += from.ms;
    binary(splits, name_of(volume), chosen);
    wide(splits, name_of(volume), chosen, SOBB_VOLUME_AABB);
  }

  void built(const char* splits, const SahSettings& settings) const {
    const auto tree = timed([&] { return build(settings); });
    binary(splits, name_of(settings.volume), tree);
    wide(splits, name_of(settings.volume), tree, SOBB_VOLUME_AABB);
  }

  const Mesh& mesh_;
  AreaMeasure measure_;
  std::vector<Vector> tangents_;
  const std::function<void(const Variant&)>& visit_;
};

}  // namespace

void each_variant(const Mesh& mesh, const MeshSummary& summary, std::pmr::memory_resource& memory,
                  const std::function<void(const Variant&)>& visit) {
  Variants(mesh, summary, memory, visit).visit_all();
}

}  // namespace sobb::study
