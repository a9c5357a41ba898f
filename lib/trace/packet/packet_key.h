// SPDX-License-Identifier: Apache-2.0
// A packet traversal's stack entry in 64 bits: a child to visit, ordered by depth.
//   bits 43-63  the least depth's exponent and upper 13 mantissa bits (it is not negative)
//   bits 35-42  the beams that met the child's node
//   bits 32-34  the child
//   bits 0-31   its node
#pragma once

#include <bit>
#include <cstdint>

namespace sobb {

using PacketKey = uint64_t;

inline constexpr PacketKey kNoPacketKey = ~PacketKey{0};

inline PacketKey make_packet_key(float near, uint32_t beams, uint32_t child, uint32_t node) {
  return static_cast<PacketKey>(std::bit_cast<uint32_t>(near) >> 10) << 43 |
         static_cast<PacketKey>(beams << 3 | child) << 32 | node;
}
inline float packet_key_depth(PacketKey key) {
  return std::bit_cast<float>(static_cast<uint32_t>(key >> 43) << 10);
}
constexpr uint32_t packet_key_beams(PacketKey key) { return key >> 35 & 0xFF; }
constexpr uint32_t packet_key_child(PacketKey key) { return key >> 32 & 7; }
constexpr uint32_t packet_key_node(PacketKey key) { return static_cast<uint32_t>(key); }

}  // namespace sobb
