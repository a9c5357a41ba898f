// SPDX-License-Identifier: Apache-2.0
// See source_name.h.
#include "scene/source_name.h"

#include <string_view>

#include "scene/builtin/builtin.h"
#include "scene/formats.h"
#include "scene/input/read_file.h"
#include "scene/subdivision/loop_subdivision.h"

namespace sobb {
namespace {

// Where the suffix that begins with `mark` is; npos in a path that is meant as it stands.
size_t find_suffix(const std::string& source, char mark) {
  const size_t at = source.rfind(mark);
  if (is_builtin(source)) return at;
  const size_t slash = source.rfind('/');
  const bool in_folder = at != std::string::npos && slash != std::string::npos && at < slash;
  const bool known = find_format(split_path(source).ending) != nullptr;
  return in_folder || known || file_exists(source) ? std::string::npos : at;
}

}  // namespace

SourceName parse_source(const std::string& source) {
  SourceName name;
  const size_t turn = find_suffix(source, '@');
  name.scene = source.substr(0, turn);
  if (turn != std::string::npos) name.turn = source.substr(turn);
  const size_t times = find_suffix(name.scene, '^');
  if (times == std::string::npos) return name;
  name.subdivisions = parse_subdivisions(source, std::string_view(name.scene).substr(times + 1));
  name.scene.resize(times);
  return name;
}

}  // namespace sobb
