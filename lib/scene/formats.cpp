// SPDX-License-Identifier: Apache-2.0
// See formats.h.
#include "scene/formats.h"

#include "scene/gltf/gltf.h"
#include "scene/input/ascii.h"
#include "scene/text/obj.h"
#include "scene/text/off.h"
#include "scene/text/ply.h"
#include "scene/text/stl.h"

namespace sobb {
namespace {

struct Format {
  std::string_view ending;
  FormatReader reader;
};

constexpr Format kFormats[] = {
    {"gltf", read_gltf}, {"glb", read_gltf}, {"obj", read_obj},
    {"ply", read_ply},   {"stl", read_stl},  {"off", read_off},
};

}  // namespace

PathParts split_path(const std::string& path) {
  PathParts parts;
  const size_t name = path.rfind('/') == std::string::npos ? 0 : path.rfind('/') + 1;
  const size_t dot = path.rfind('.');
  parts.folder = path.substr(0, name);
  if (dot == std::string::npos || dot < name) {
    parts.stem = path.substr(name);
    return parts;
  }
  parts.stem = path.substr(name, dot - name);
  for (const char c : path.substr(dot + 1)) parts.ending += ascii_lower(c);
  return parts;
}

FormatReader find_format(std::string_view ending) {
  for (const Format& format : kFormats) {
    if (format.ending == ending) return format.reader;
  }
  return nullptr;
}

std::string known_endings() {
  std::string endings;
  for (const Format& format : kFormats) {
    endings += (endings.empty() ? "." : ", .") + std::string(format.ending);
  }
  return endings;
}

}  // namespace sobb
