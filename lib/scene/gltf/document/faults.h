// SPDX-License-Identifier: Apache-2.0
// GltfFaults keeps what is wrong with the items of a document: a malformed item costs the scene
// only where a triangle needs it.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "scene/model/scene_writer.h"

namespace sobb {

enum class GltfItem { kScene, kNode, kMesh, kAccessor, kView, kBuffer, kCamera, kPart };

class GltfFaults {
 public:
  // Item `index` of its kind is malformed; `fault` says its place and what is wrong.
  void add(GltfItem kind, size_t index, std::string fault);
  // Notes a fault of a part of an item, a part that no triangle needs.
  void add_part(std::string fault) { add(GltfItem::kPart, faults_.size(), std::move(fault)); }

  bool has(GltfItem kind, size_t index) const { return faults_.count({kind, index}) != 0; }

  // Whoever needs an item asks for it first. Error SCENE_SYNTAX, with `name` and the fault.
  void check(GltfItem kind, size_t index, const std::string& name) const;

  // Notes every malformed item, once no triangle has needed one.
  void note(SceneWriter& writer) const;

 private:
  std::map<std::pair<GltfItem, size_t>, std::string> faults_;
};

}  // namespace sobb
