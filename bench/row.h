// SPDX-License-Identifier: Apache-2.0
// The names of the rows: KIND/METHOD/CALL.
#pragma once

#include <array>
#include <string>

namespace sobb::bench {

enum class RayKind { kPrimary, kShadow, kDiffuse, kRandom };
inline constexpr std::array kRayKinds{RayKind::kPrimary, RayKind::kShadow, RayKind::kDiffuse,
                                      RayKind::kRandom};

/// How rays are handed over: one a call, 16 a call (Embree: 8), or the whole array in one call.
enum class Call { kSingle, kPacket, kArray };
inline constexpr std::array kCalls{Call::kSingle, Call::kPacket, Call::kArray};

enum class Method { kAabb, kSobb, kEmbreeMedium, kEmbreeHigh };
inline constexpr std::array kSubjects{Method::kAabb, Method::kSobb};
inline constexpr std::array kPeers{Method::kEmbreeMedium, Method::kEmbreeHigh};

inline std::string name_of(RayKind kind) {
  constexpr std::array kNames{"primary", "shadow", "diffuse", "random"};
  return kNames[static_cast<size_t>(kind)];
}

inline std::string name_of(Call call) {
  constexpr std::array kNames{"single", "packet", "array"};
  return kNames[static_cast<size_t>(call)];
}

inline std::string name_of(Method method) {
  constexpr std::array kNames{"aabb", "sobb", "embree_medium", "embree_high"};
  return kNames[static_cast<size_t>(method)];
}

inline std::string row_name(RayKind kind, Method method, Call call) {
  return name_of(kind) + "/" + name_of(method) + "/" + name_of(call);
}

}  // namespace sobb::bench
