// SPDX-License-Identifier: Apache-2.0
// Numbers out of binary files, at any alignment and in either order of bytes.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>

namespace sobb {

template <class T>
T load_bytes(const char* from, std::endian order) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, from, sizeof bytes);
  if (order != std::endian::native) std::reverse(bytes, bytes + sizeof bytes);
  return std::bit_cast<T>(bytes);
}

}  // namespace sobb
