// SPDX-License-Identifier: Apache-2.0
// What a bounding volume is to the comparison. Each is one file, NAME-inl.h, compiled for every
// instruction set.
#pragma once

#include <concepts>
#include <cstdint>

#include "volumes/tables.h"
#include "volumes/triangles_below.h"

namespace sobb::study {

// A volume V has
//   V::Hull         what nodes know of their triangles: fit(tables, points, count) to a leaf's
//                   vertices, merge(other) into the parent's
//   V::fit          the volume of a hull, and of the triangles below where the hull does not do
//   area, contains  its surface area; whether a point, relative to the centre, is within: exactly
//   V::Children<W>  those of a node, structure of arrays: set(i, volume), get(i)
//   V::Ray, V::clip the ray's side of the test, and the test of as many children as a vector has
//                   lanes: it clips their intervals (trace/node_test-inl.h), and is conservative
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
