// SPDX-License-Identifier: Apache-2.0
// See faults.h.
#include "scene/gltf/document/faults.h"

#include "base/error.h"

namespace sobb {

void GltfFaults::add(GltfItem kind, size_t index, std::string fault) {
  faults_.emplace(std::pair(kind, index), std::move(fault));
}

void GltfFaults::check(GltfItem kind, size_t index, const std::string& name) const {
  const auto found = faults_.find({kind, index});
  if (found == faults_.end()) return;
  fail(SOBB_ERROR_SCENE_SYNTAX, "%s: %s", name.c_str(), found->second.c_str());
}

void GltfFaults::note(SceneWriter& writer) const {
  for (const auto& [item, fault] : faults_) {
    writer.note(SOBB_NOTE_UNUSED_ITEM, [&text = fault] { return text; });
  }
}

}  // namespace sobb
