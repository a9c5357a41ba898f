// SPDX-License-Identifier: Apache-2.0
// The names of the rows: KIND/METHOD/CALL.
#pragma once

#include <array>
#include <string>

namespace sobb::bench {

enum class RayKind { kPrimary, kShadow, kDiffuse1, kDiffuse7, kRandom };
inline constexpr std::array kRayKinds{RayKind::kPrimary, RayKind::kShadow, RayKind::kDiffuse1,
                                      RayKind::kDiffuse7, RayKind::kRandom};

/// How rays are handed over: one per call, 16 per call (Embree: 8), or the whole array in one call.
enum class Call { kSingle, kPacket, kArray };
inline constexpr std::array kCalls{Call::kSingle, Call::kPacket, Call::kArray};

/// Our hierarchies, of the quality that the flags name or of high quality; Embree's, without and
/// with its robust flag.
enum class Method {
  kAabb,
  kSobb,
  kAabbHigh,
  kSobbHigh,
  kEmbreeMedium,
  kEmbreeHigh,
  kEmbreeMediumRobust,
  kEmbreeHighRobust
};
inline constexpr std::array kMethods{Method::kAabb,
                                     Method::kSobb,
                                     Method::kAabbHigh,
                                     Method::kSobbHigh,
                                     Method::kEmbreeMedium,
                                     Method::kEmbreeHigh,
                                     Method::kEmbreeMediumRobust,
                                     Method::kEmbreeHighRobust};

inline bool is_aabb(Method method) {
  return method == Method::kAabb || method == Method::kAabbHigh;
}

inline bool is_peer(Method method) { return method >= Method::kEmbreeMedium; }

inline bool is_robust(Method method) { return method >= Method::kEmbreeMediumRobust; }

inline bool is_high(Method method) {
  return method == Method::kAabbHigh || method == Method::kSobbHigh ||
         method == Method::kEmbreeHigh || method == Method::kEmbreeHighRobust;
}

inline std::string name_of(RayKind kind) {
  constexpr std::array kNames{"primary", "shadow", "diffuse1", "diffuse7", "random"};
  return kNames[static_cast<size_t>(kind)];
}

inline std::string name_of(Call call) {
  constexpr std::array kNames{"single", "packet", "array"};
  return kNames[static_cast<size_t>(call)];
}

inline std::string name_of(Method method) {
  constexpr std::array kNames{"aabb",
                              "sobb",
                              "aabb_high",
                              "sobb_high",
                              "embree_medium",
                              "embree_high",
                              "embree_medium_robust",
                              "embree_high_robust"};
  return kNames[static_cast<size_t>(method)];
}

inline std::string row_name(RayKind kind, Method method, Call call) {
  return name_of(kind) + "/" + name_of(method) + "/" + name_of(call);
}

}  // namespace sobb::bench
