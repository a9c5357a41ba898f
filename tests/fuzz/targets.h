// SPDX-License-Identifier: Apache-2.0
// The targets that are fuzzed. A target takes bytes of any kind and returns. It aborts where a
// promise does not hold; the sanitizers see the rest.
#pragma once

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <span>

namespace sobb::fuzz {

using Bytes = std::span<const std::byte>;

void open(Bytes bytes);         // opens a .sobb file as it is
void open_mended(Bytes bytes);  // the same with sizes and checksums made to fit
void trace(Bytes bytes);        // traces in every way what opens once mended
void obj(Bytes bytes);
void ply(Bytes bytes);
void stl(Bytes bytes);
void off(Bytes bytes);
void gltf(Bytes bytes);
void glb(Bytes bytes);
void views(Bytes bytes);

struct Target {
  const char* name;  // names the program and the corpus' folder
  void (*run)(Bytes bytes);
};

inline constexpr Target kTargets[] = {
    {"open", open},   {"open_mended", open_mended},
    {"trace", trace}, {"obj", obj},
    {"ply", ply},     {"stl", stl},
    {"off", off},     {"gltf", gltf},
    {"glb", glb},     {"views", views},
};

// Aborts where `promise`, which no input may break, was not kept.
inline void expect(bool kept, const char* promise) {
  if (kept) return;
  std::fprintf(stderr, "broken: %s\n", promise);
  std::abort();
}

}  // namespace sobb::fuzz
