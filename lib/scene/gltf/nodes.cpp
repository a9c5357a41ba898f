// SPDX-License-Identifier: Apache-2.0
// See nodes.h.
#include "scene/gltf/nodes.h"

#include <algorithm>

#include "base/error.h"

namespace sobb {
namespace {

using Vector = std::array<double, 3>;

GltfTransform from_matrix(const std::vector<double>& columns) {
  GltfTransform result;
  bool identity = true;
  for (size_t row = 0; row < 3; ++row) {
    for (size_t column = 0; column < 3; ++column) {
      result.linear[row][column] = columns[4 * column + row];
      identity = identity && result.linear[row][column] == (row == column ? 1 : 0);
    }
    result.translation[row] = columns[12 + row];
    identity = identity && result.translation[row] == 0;
  }
  result.identity = identity;
  return result;
}

// The rotation matrix of q / |q|, since files round their unit quaternions.
std::array<Vector, 3> rotation(double x, double y, double z, double w) {
  const double norm = x * x + y * y + z * z + w * w;
  const double s = norm > 0 ? 2 / norm : 0;
  return {{{1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)},
           {s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)},
           {s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)}}};
}

GltfTransform local_transform(const tinygltf::Node& node) {
  if (!node.matrix.empty()) return from_matrix(node.matrix);
  GltfTransform result;
  const auto all = [](const std::vector<double>& numbers, double value) {
    return std::all_of(numbers.begin(), numbers.end(), [=](double x) { return x == value; });
  };
  const std::vector<double>& q = node.rotation;
  const bool turned = !q.empty() && (q[0] != 0 || q[1] != 0 || q[2] != 0);
  result.identity = !turned && all(node.scale, 1) && all(node.translation, 0);
  if (turned) result.linear = rotation(q[0], q[1], q[2], q[3]);
  for (size_t row = 0; row < 3; ++row) {
    for (size_t k = 0; k < node.scale.size(); ++k) result.linear[row][k] *= node.scale[k];
    if (!node.translation.empty()) result.translation[row] = node.translation[row];
  }
  return result;
}

GltfTransform product(const GltfTransform& outer, const GltfTransform& inner) {
  if (outer.identity) return inner;
  if (inner.identity) return outer;
  GltfTransform result;
  result.identity = false;
  result.translation = outer.point(inner.translation);
  for (size_t row = 0; row < 3; ++row) {
    for (size_t column = 0; column < 3; ++column) {
      result.linear[row][column] = outer.linear[row][0] * inner.linear[0][column] +
                                   outer.linear[row][1] * inner.linear[1][column] +
                                   outer.linear[row][2] * inner.linear[2][column];
    }
  }
  return result;
}

// Nodes may be placed so many times more than there are nodes.
constexpr uint64_t kMostPlacedAgain = uint64_t{1} << 22;

class NodeWalk {
 public:
  NodeWalk(const GltfDocument& document, SceneWriter& writer)
      : document_(document), model_(document.model), writer_(writer) {}

  std::vector<GltfPlacedNode> placed_nodes() {
    const std::vector<int> first = roots();
    check_tree(first);
    push(first, {}, false);
    std::vector<GltfPlacedNode> result;
    // A stack of our own, no recursion: a file may nest its nodes as deep as it likes.
    while (!waiting_.empty()) {
      const Waiting next = waiting_.back();
      waiting_.pop_back();
      if (!next.hidden) result.push_back(next.placed);
      push(model_.nodes[size_t(next.placed.node)].children, next.placed.transform, next.hidden);
    }
    return result;
  }

 private:
  struct Waiting {
    GltfPlacedNode placed;
    bool hidden;
  };

  std::vector<int> roots() const {
    if (!model_.scenes.empty()) {
      const int scene = std::max(model_.defaultScene, 0);
      if (size_t(scene) >= model_.scenes.size()) {
        fail(SOBB_ERROR_SCENE_SYNTAX, "%s: the default scene, %d, does not exist", name(), scene);
      }
      document_.faults.check(GltfItem::kScene, size_t(scene), writer_.name());
      return model_.scenes[size_t(scene)].nodes;
    }
    std::vector<bool> child(model_.nodes.size());
    for (const tinygltf::Node& node : model_.nodes) {
      for (const int i : node.children) {
        if (i >= 0 && size_t(i) < child.size()) child[size_t(i)] = true;
      }
    }
    std::vector<int> result;
    for (size_t i = 0; i < child.size(); ++i) {
      if (!child[i]) result.push_back(int(i));
    }
    return result;
  }

  // Checks that every node reached exists, is well formed, and is not below itself.
  void check_tree(const std::vector<int>& first) {
    enum State : char { kNew, kOpen, kDone };
    std::vector<State> states(model_.nodes.size(), kNew);
    struct Step {
      const std::vector<int>* nodes;
      size_t next;
    };
    std::vector<Step> path{{&first, 0}};
    std::vector<int> open;
    while (!path.empty()) {
      Step& step = path.back();
      if (step.next == step.nodes->size()) {
        path.pop_back();
        if (open.empty()) break;
        states[size_t(open.back())] = kDone;
        open.pop_back();
        continue;
      }
      const int node = (*step.nodes)[step.next++];
      if (node < 0 || size_t(node) >= states.size()) {
        fail(SOBB_ERROR_SCENE_SYNTAX, "%s: node %d does not exist", name(), node);
      }
      document_.faults.check(GltfItem::kNode, size_t(node), writer_.name());
      if (states[size_t(node)] == kOpen) {
        fail(SOBB_ERROR_SCENE_SYNTAX, "%s: nodes form a cycle at nodes[%d]", name(), node);
      }
      if (states[size_t(node)] == kDone) continue;
      states[size_t(node)] = kOpen;
      open.push_back(node);
      path.push_back({&model_.nodes[size_t(node)].children, 0});
    }
    if (model_.scenes.empty() && std::ranges::count(states, kNew) != 0) {
      fail(SOBB_ERROR_SCENE_SYNTAX, "%s: nodes form a cycle", name());
    }
  }

  void push(const std::vector<int>& nodes, const GltfTransform& parent, bool hidden) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
      count_placed();
      const auto index = size_t(*node);
      waiting_.push_back({{*node, product(parent, local_transform(model_.nodes[index]))},
                          hidden || document_.hidden[index]});
    }
  }

  // A node is to have one parent. Writers that give it several mean an instance below each; few
  // nodes may then be very many.
  void count_placed() {
    writer_.work(1);
    if (++placed_ <= model_.nodes.size()) return;
    if (placed_ > model_.nodes.size() + kMostPlacedAgain) {
      fail(SOBB_ERROR_TOO_LARGE, "%s: nodes have several parents, and are placed too often",
           name());
    }
    writer_.hold(kPlacedBytes);
  }

  const char* name() const { return writer_.name().c_str(); }

  // In two arrays that double.
  static constexpr uint64_t kPlacedBytes = 3 * (sizeof(GltfPlacedNode) + sizeof(Waiting));

  const GltfDocument& document_;
  const tinygltf::Model& model_;
  SceneWriter& writer_;
  uint64_t placed_ = 0;
  std::vector<Waiting> waiting_;
};

}  // namespace

std::array<double, 3> GltfTransform::vector(const std::array<double, 3>& v) const {
  std::array<double, 3> result{};
  for (size_t k = 0; k < 3; ++k) {
    result[k] = linear[k][0] * v[0] + linear[k][1] * v[1] + linear[k][2] * v[2];
  }
  return result;
}

std::array<double, 3> GltfTransform::point(const std::array<double, 3>& p) const {
  std::array<double, 3> result = vector(p);
  for (size_t k = 0; k < 3; ++k) result[k] += translation[k];
  return result;
}

std::vector<GltfPlacedNode> place_gltf_nodes(const GltfDocument& document, SceneWriter& writer) {
  return NodeWalk(document, writer).placed_nodes();
}

}  // namespace sobb
