// SPDX-License-Identifier: Apache-2.0
// How far are the volumes' areas from the least that a skewed box can have? On sampled nodes of the
// binary topology: every volume of the paper, and the best that three free normals give.
#include "study/areas/node_sample.h"
#include "study/areas/volume_areas.h"
#include "study/study_scene.h"

namespace sobb::study {
namespace {

// Free normals cost some ten thousand widths per node, so larger nodes get none.
constexpr uint64_t kLargestOptimised = 4096;
constexpr uint64_t kAnySize = ~uint64_t{0};
constexpr const char* kFreeNormals = "free normals";

// Means, over the draws, of the ratio of each method's area to the box's.
std::vector<double> mean_ratios(const StudyScene& scene, const Topology& topology,
                                const VolumeAreas& volumes, const NodeSample& sample,
                                bool optimise) {
  std::vector<std::vector<double>> ratios(sample.nodes.size());
  scene.scheduler().for_each(sample.nodes.size(), [&](uint64_t i) {
    const SampledNode& sampled = sample.nodes[i];
    const PointSet points(scene.mesh(), topology, *sampled.node);
    VolumeAreas::Areas areas = volumes.measure(points);
    if (optimise) areas.by_method.push_back(optimise_normals(points, areas.normals));
    for (double& area : areas.by_method)
      area *= sampled.times / (2 * sampled.node->box.half_area());
    ratios[i] = std::move(areas.by_method);
  });
  std::vector<double> means(volumes.names().size() + (optimise ? 1 : 0));
  for (const auto& of_node : ratios) {
    for (size_t m = 0; m < means.size(); ++m) means[m] += of_node[m] / sample.draws;
  }
  return means;
}

Json measure_kind(const StudyScene& scene, const VolumeAreas& volumes, const Topology& topology,
                  NodeKind kind, uint32_t draws, bool optimise) {
  const NodeSample sample =
      sample_nodes(topology, kind, draws, optimise ? kLargestOptimised : kAnySize);
  Json ratios;
  const std::vector<double> means = mean_ratios(scene, topology, volumes, sample, optimise);
  for (size_t m = 0; m < means.size(); ++m) {
    const bool last = m == volumes.names().size();
    ratios[last ? kFreeNormals : volumes.names()[m]] = rounded(means[m]);
  }
  return {{"kind", name_of(kind)},
          {"nodes", sample.count},
          {"box_area", rounded(sample.box_area / scene.box_area())},
          {"distinct", sample.nodes.size()},
          {"ratio", ratios}};
}

}  // namespace

int areas(const StudyOptions& options) {
  write_report(options, "areas", for_each_scene(options, [&](StudyScene& scene) {
                 const Topology topology = scene.build_topology();
                 const VolumeAreas volumes(scene.summary(), scene.memory());
                 Json sampled = Json::array();
                 Json optimised = Json::array();
                 for (const NodeKind kind : kNodeKinds) {
                   sampled.push_back(measure_kind(scene, volumes, topology, kind,
                                                  options.nodes / kNodeKinds.size(), false));
                   optimised.push_back(
                       measure_kind(scene, volumes, topology, kind, options.optimised_nodes, true));
                 }
                 return Json{{"sampled", sampled}, {"optimised", optimised}};
               }));
  return 0;
}

}  // namespace sobb::study
