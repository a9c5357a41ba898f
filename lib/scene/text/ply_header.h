// SPDX-License-Identifier: Apache-2.0
// Reads the header of a PLY file: its encoding, and the elements and properties of its data.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene/text/text_reader.h"

namespace sobb {

enum class PlyEncoding { kAscii, kLittleEndian, kBigEndian };

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

inline bool is_integer(PlyType type) { return type < PlyType::kFloat; }
uint64_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat;  // of a list's values
  bool list = false;
  PlyType count_type = PlyType::kUint8;  // of a list's length; an integer type
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kAscii;
  std::vector<PlyElement> elements;  // in the order of their data
  std::string_view data;             // what follows the header
};

// Reads from the first line to that of end_header, where it leaves `text`. Lines that begin with no
// keyword are passed over with a note.
//
// Errors, with the line: SCENE_SYNTAX for a malformed line or counts of elements that the rest of
// the file cannot hold; SCENE_UNSUPPORTED for another version than 1.0.
PlyHeader read_ply_header(TextReader& text, SceneWriter& writer);

}  // namespace sobb
