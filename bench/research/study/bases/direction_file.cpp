// SPDX-License-Identifier: Apache-2.0
#include "study/bases/direction_file.h"

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace sobb::study {

std::vector<Direction> read_directions(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be opened");
  std::vector<Direction> directions;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    std::istringstream fields(line);
    double x = 0;
    double y = 0;
    double z = 0;
    const bool read = static_cast<bool>(fields >> x >> y >> z);
    const double length = std::hypot(x, y, z);
    if (!read || !(fields >> std::ws).eof() || !(length > 0) || !std::isfinite(length)) {
      throw std::runtime_error(path + ", line " + std::to_string(number) + ": not a direction");
    }
    directions.push_back({static_cast<float>(x / length), static_cast<float>(y / length),
                          static_cast<float>(z / length)});
  }
  if (directions.size() < 3 || directions.size() > kMaxDirections) {
    throw std::runtime_error(path + ": has " + std::to_string(directions.size()) +
                             " directions, not 3 to " + std::to_string(kMaxDirections));
  }
  return directions;
}

}  // namespace sobb::study
