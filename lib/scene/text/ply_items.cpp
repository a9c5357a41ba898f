// SPDX-License-Identifier: Apache-2.0
// See ply_items.h.
#include "scene/text/ply_items.h"

#include <algorithm>

#include "base/error.h"
#include "scene/input/load_bytes.h"

namespace sobb {

const char* PlyBinaryItems::take(uint64_t bytes) {
  if (bytes > static_cast<uint64_t>(end_ - at_)) {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: %s: the file ends within it", name_, place().c_str());
  }
  const char* taken = at_;
  at_ += bytes;
  progress_.at(at_);
  return taken;
}

double PlyBinaryItems::value(PlyType type) {
  const char* from = take(size_of(type));
  switch (type) {
    case PlyType::kInt8:
      return load_bytes<int8_t>(from, order_);
    case PlyType::kUint8:
      return load_bytes<uint8_t>(from, order_);
    case PlyType::kInt16:
      return load_bytes<int16_t>(from, order_);
    case PlyType::kUint16:
      return load_bytes<uint16_t>(from, order_);
    case PlyType::kInt32:
      return load_bytes<int32_t>(from, order_);
    case PlyType::kUint32:
      return load_bytes<uint32_t>(from, order_);
    case PlyType::kFloat:
      return load_bytes<float>(from, order_);
    case PlyType::kDouble:
      break;
  }
  return load_bytes<double>(from, order_);
}

uint64_t PlyBinaryItems::length(const PlyProperty& property) {
  const double length = value(property.count_type);
  if (length < 0) {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: %s: a list of length %.0f", name_, place().c_str(), length);
  }
  return static_cast<uint64_t>(length);
}

uint64_t PlyBinaryItems::vertex_index(const PlyProperty& property, uint64_t vertices) {
  const double index = value(property.type);
  if (index < 0 || index >= static_cast<double>(vertices)) {
    fail(SOBB_ERROR_INDEX, "%s: %s: there is no vertex %.0f: they are %llu, from 0", name_,
         place().c_str(), index, static_cast<unsigned long long>(vertices));
  }
  return static_cast<uint64_t>(index);
}

bool PlyBinaryItems::take_strip_end(const PlyProperty& property) {
  const char* before = at_;
  const double index = value(property.type);
  // Unsigned lists have the same bits.
  if (index == -1 || (property.type == PlyType::kUint32 && index == UINT32_MAX)) return true;
  at_ = before;
  return false;
}

std::string PlyBinaryItems::place() const {
  return quote(element_->name) + " " + std::to_string(index_);
}

void PlyBinaryItems::pass_surplus(SceneWriter& writer) const {
  // Some writers end even binary files with a line's end.
  const auto is_space = [](char c) { return c == '\n' || c == '\r' || c == ' '; };
  if (std::all_of(at_, end_, is_space)) return;
  const auto bytes = static_cast<uint64_t>(end_ - at_);
  writer.note(
      SOBB_NOTE_SURPLUS,
      [bytes] { return std::to_string(bytes) + " bytes more than the header declares"; }, bytes);
}

}  // namespace sobb
