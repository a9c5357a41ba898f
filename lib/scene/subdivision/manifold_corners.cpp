// SPDX-License-Identifier: Apache-2.0
// See manifold_corners.h.
#include "scene/subdivision/manifold_corners.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

namespace sobb {
namespace {

constexpr uint32_t kNone = 0xFFFFFFFF;

// A triangle's edge.
struct Edge {
  uint32_t low;  // its ends, in order
  uint32_t high;
  uint32_t corner;  // where it begins
};

uint32_t next_corner(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
uint32_t previous_corner(uint32_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

// Sorts, and reports progress on the way: a large scene takes seconds.
template <class T, class Key>
void sort_by(std::vector<T>& items, SceneWriter& writer, const Key& key) {
  std::sort(items.begin(), items.end(), [&](const T& a, const T& b) {
    writer.work(1);
    return key(a) < key(b);
  });
}

// For each of the scene's vertices, the first one at its place.
std::vector<uint32_t> weld(const Scene& scene, SceneWriter& writer) {
  const auto place = [&](uint32_t vertex) {
    const float* v = &scene.vertices[size_t(3) * vertex];
    return std::array<float, 3>{v[0], v[1], v[2]};
  };
  std::vector<uint32_t> order(scene.vertices.size() / 3);
  std::iota(order.begin(), order.end(), 0U);
  sort_by(order, writer, [&](uint32_t vertex) { return std::tuple(place(vertex), vertex); });
  std::vector<uint32_t> first(order.size());
  for (size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && place(order[i - 1]) == place(order[i]);
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

class FanFinder {
 public:
  FanFinder(const Scene& scene, SceneWriter& writer)
      : scene_(scene), writer_(writer), first_(weld(scene, writer)) {}

  ManifoldCorners find() {
    const size_t corners = scene_.indices.size();
    twin_.assign(corners, kNone);
    pair_edges();
    result_.edge_count += corners;
    result_.vertex_of_corner.assign(corners, kNone);
    for (uint32_t corner = 0; corner < corners; ++corner) {
      if (result_.vertex_of_corner[corner] == kNone) add_vertex(corner);
    }
    return std::move(result_);
  }

 private:
  uint32_t place(uint32_t corner) const { return first_[scene_.indices[corner]]; }

  bool degenerate(uint32_t triangle) const {
    const uint32_t a = place(3 * triangle);
    const uint32_t b = place(3 * triangle + 1);
    const uint32_t c = place(3 * triangle + 2);
    return a == b || b == c || c == a;
  }

  std::vector<Edge> sorted_edges() {
    std::vector<Edge> edges;
    edges.reserve(scene_.indices.size());
    for (uint32_t triangle = 0; triangle < scene_.indices.size() / 3; ++triangle) {
      if (degenerate(triangle)) continue;
      for (uint32_t corner = 3 * triangle; corner < 3 * triangle + 3; ++corner) {
        const auto [low, high] = std::minmax({place(corner), place(next_corner(corner))});
        edges.push_back({low, high, corner});
      }
    }
    sort_by(edges, writer_, [](const Edge& e) { return std::tuple(e.low, e.high, e.corner); });
    return edges;
  }

  // Fills twin_, and counts the edges that two triangles share once.
  void pair_edges() {
    const std::vector<Edge> edges = sorted_edges();
    for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
      while (end < edges.size() && edges[end].low == edges[begin].low &&
             edges[end].high == edges[begin].high) {
        ++end;
      }
      if (end - begin != 2) continue;
      const uint32_t a = edges[begin].corner;
      const uint32_t b = edges[begin + 1].corner;
      if (place(a) == place(b)) continue;  // they run in the same direction
      twin_[a] = b;
      twin_[b] = a;
      --result_.edge_count;
    }
  }

  // Makes a vertex of all corners of the fan that `corner` is in: goes one way about it, and, where
  // the surface ends, the other way.
  void add_vertex(uint32_t corner) {
    const auto vertex = uint32_t(result_.scene_vertex.size());
    result_.scene_vertex.push_back(place(corner));
    uint64_t edges = 1;
    const auto add = [&](uint32_t c) {
      writer_.work(1);
      result_.vertex_of_corner[c] = vertex;
      ++edges;
    };
    uint32_t c = corner;
    do {
      add(c);
      c = twin_[previous_corner(c)];
    } while (c != kNone && c != corner);
    if (c == kNone) {
      for (uint32_t t = twin_[corner]; t != kNone; t = twin_[c]) {
        c = next_corner(t);
        add(c);
      }
    }
    result_.most_edges = std::max(result_.most_edges, edges);
  }

  const Scene& scene_;
  SceneWriter& writer_;
  std::vector<uint32_t> first_;
  std::vector<uint32_t> twin_;  // per corner: the edge that begins there, as a neighbour has it
  ManifoldCorners result_;
};

}  // namespace

ManifoldCorners find_manifold_corners(const Scene& scene, SceneWriter& writer) {
  // Per vertex the welding's order and result; per corner its edge, twin and vertex, and at worst a
  // vertex of its own.
  writer.check_room(scene.vertices.size() / 3 * 2 * sizeof(uint32_t) +
                    scene.indices.size() * (sizeof(Edge) + 4 * sizeof(uint32_t)));
  return FanFinder(scene, writer).find();
}

}  // namespace sobb
