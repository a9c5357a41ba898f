// SPDX-License-Identifier: Apache-2.0
// A direction table as text, to measure tables that are not the library's.
#pragma once

#include <string>
#include <vector>

#include "bounds/basis.h"

namespace sobb::study {

// Lines `x y z`, 3 to kMaxDirections of them; vectors of any length but zero become unit. Throws
// std::runtime_error naming the file and the line.
std::vector<Direction> read_directions(const std::string& path);

}  // namespace sobb::study
