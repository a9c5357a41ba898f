// SPDX-License-Identifier: Apache-2.0
// The concept Volume says what the comparison asks of a bounding volume. Each volume is one file,
// NAME-inl.h, compiled for every instruction set.
#pragma once

#include <concepts>
#include <cstdint>

#include "volumes/tables.h"
#include "volumes/triangles_below.h"

namespace sobb::study {

// A volume V has
//   V::Hull         what a node remembers of its triangles: fit(tables, points, count) bounds a
//                   leaf's vertices, merge(other) adds a child's hull to its parent's
//   V::fit          makes the volume from a hull, or from the triangles below where the hull does
//                   not suffice
//   area, contains  its surface area; whether a point, relative to the centre, is exactly inside
//   V::Children<W>  the volumes of a node, as a structure of arrays: set(i, volume), get(i)
//   V::Ray, V::clip the ray's side of the test, and the test of as many children as a vector has
//                   lanes: it clips their intervals (trace/nodes/node_test-inl.h) conservatively
template <class V>
concept Volume = requires(const V& volume, const Tables& tables, typename V::Hull& hull,
                          const RelativePoint* points, const TrianglesBelow& below,
                          const double (&point)[3], typename V::template Children<8>& children) {
  hull.fit(tables, points, uint64_t{});
  hull.merge(hull);
  { V::fit(tables, hull, below) } -> std::same_as<V>;
  { volume.area(tables) } -> std::same_as<double>;
  { volume.contains(tables, point) } -> std::same_as<bool>;
  children.set(uint32_t{}, volume);
  { children.get(uint32_t{}) } -> std::same_as<V>;
  typename V::Ray;
};

}  // namespace sobb::study
