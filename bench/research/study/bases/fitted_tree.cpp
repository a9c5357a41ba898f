// SPDX-License-Identifier: Apache-2.0
#include "study/bases/fitted_tree.h"

namespace sobb::study {
namespace {

std::vector<Kdop> fit(const StudyScene& scene, const Tree& tree, const DirectionTable& directions) {
  const Point& middle = scene.summary().centre;
  const float centre[3] = {middle.x, middle.y, middle.z};
  return fit_children(tree, scene.mesh(), centre, directions, scene.scheduler());
}

}  // namespace

FittedTree::FittedTree(StudyScene& scene, const Topology& topology, uint32_t width,
                       std::span<const Direction> directions)
    : scene_(scene),
      directions_(make_direction_table(directions)),
      tree_(make_tree(topology, width, scene.scheduler(), scene.memory())),
      kdops_(fit(scene, tree_, directions_)),
      chooser_(directions, tree_, kdops_, scene.summary().radius, scene.scheduler(),
               scene.memory()) {}

AreaSums FittedTree::areas(const std::vector<uint16_t>& bases) const {
  return sum_areas(tree_, kdops_, bases, directions_, scene_.box_area());
}

BoundedTree FittedTree::bounded(const std::vector<uint16_t>& bases) const {
  return {tree_, kdops_, bases, directions_, scene_.summary(), scene_.mesh()};
}

}  // namespace sobb::study
