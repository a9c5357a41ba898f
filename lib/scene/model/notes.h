// SPDX-License-Identifier: Apache-2.0
// Notes say what a reader passed over: one bad item costs that item and a note, never the scene.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>

#include "scene/model/scene.h"

namespace sobb {

// Returns the scene's note for `cause`, a new one without a text where there was none.
SceneNote& note_for(Scene& scene, sobb_note_cause cause);

// Counts `count` items as passed over for `cause`. `message` makes the text for the first of them,
// its place and fault ("line 12: a face of 2 corners"), and is not called for the others.
template <std::invocable Message>
void add_note(Scene& scene, sobb_note_cause cause, const Message& message, uint64_t count = 1) {
  SceneNote& note = note_for(scene, cause);
  if (note.count == 0) note.first = message();
  note.count += count;
}

// A cause in words for people.
const char* note_cause_name(uint32_t cause);

}  // namespace sobb
