// SPDX-License-Identifier: Apache-2.0
// Loads numbers of binary files, at any alignment and in either order of bytes.
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

template <class T>
T load_little(const char* from) {
  return load_bytes<T>(from, std::endian::little);
}

}  // namespace sobb
