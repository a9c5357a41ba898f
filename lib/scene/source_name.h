// SPDX-License-Identifier: Apache-2.0
// Takes apart the name of a source: SOURCE[^TIMES][@DEGREES].
#pragma once

#include <string>

namespace sobb {

struct SourceName {
  std::string scene;  // a path, or a built-in scene's name
  unsigned subdivisions = 0;
  std::string turn;  // with its '@', or empty
};

// A '^' or '@' of a path is a suffix only where the path as it stands names no file and has no
// known ending. Error SCENE_SYNTAX for a wrong number of TIMES; DEGREES are not looked at.
SourceName parse_source(const std::string& source);

}  // namespace sobb
