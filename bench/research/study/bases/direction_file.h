// SPDX-License-Identifier: Apache-2.0
// A text file gives a direction table, to measure tables that are not the library's.
#pragma once

#include <string>
#include <vector>

#include "bounds/basis.h"

namespace sobb::study {

// Reads 3 to kMaxDirections lines `x y z`; vectors of any length but zero become unit vectors.
// Throws std::runtime_error naming the file and the line.
std::vector<Direction> read_directions(const std::string& path);

}  // namespace sobb::study
