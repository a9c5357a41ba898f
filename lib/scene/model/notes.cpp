// SPDX-License-Identifier: Apache-2.0
// See notes.h.
#include "scene/model/notes.h"

#include <algorithm>

namespace sobb {

const char* note_cause_name(uint32_t cause) {
  switch (cause) {
    case SOBB_NOTE_SHORT_FACE:
      return "faces of fewer than three corners";
    case SOBB_NOTE_UNUSED_VERTEX:
      return "unusable vertices that no triangle uses";
    case SOBB_NOTE_SURPLUS:
      return "data behind what the file declares";
    case SOBB_NOTE_UNUSED_ITEM:
      return "malformed items that no triangle needs";
    case SOBB_NOTE_EXTENSION:
      return "extensions that move no triangle";
    case SOBB_NOTE_VIEWS:
      return "a cameras.json of another program";
    default:
      return "unknown cause";
  }
}

SceneNote& note_for(Scene& scene, sobb_note_cause cause) {
  const auto at = std::lower_bound(
      scene.notes.begin(), scene.notes.end(), cause,
      [](const SceneNote& note, sobb_note_cause wanted) { return note.cause < wanted; });
  if (at != scene.notes.end() && at->cause == cause) return *at;
  return *scene.notes.insert(at, {cause, 0, ""});
}

}  // namespace sobb
