// SPDX-License-Identifier: Apache-2.0
// See meshopt.h.
#include "scene/gltf/buffers/meshopt.h"

#include "base/error.h"

#ifdef SOBB_WITH_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

namespace sobb {
namespace {

[[noreturn]] void refuse(sobb_status status, const GltfMeshopt& view, const std::string& place,
                         const SceneWriter& writer, const std::string& cause) {
  fail(status, "%s: %s: %s: %s", writer.name().c_str(), place.c_str(), view.extension,
       cause.c_str());
}

}  // namespace

#ifdef SOBB_WITH_MESHOPTIMIZER

namespace {

constexpr uint64_t kWholeTriangle = 3;

// The decoders' smallest encodings: a byte per triangle or index; of vertices a quarter of a byte
// per 256 vertices, as version 1 of the encoding leaves out bytes that do not change.
constexpr uint64_t kMostVertexBytesPerByte = 1024;

enum class Mode { kAttributes, kTriangles, kIndices };

Mode mode_of(const GltfMeshopt& view, const std::string& place, const SceneWriter& writer) {
  if (view.mode == "ATTRIBUTES") return Mode::kAttributes;
  if (view.mode == "TRIANGLES") return Mode::kTriangles;
  if (view.mode == "INDICES") return Mode::kIndices;
  refuse(SOBB_ERROR_SCENE_UNSUPPORTED, view, place, writer,
         "the mode " + view.mode.substr(0, 40) + " is not supported");
}

// Checks what libmeshoptimizer takes for granted, and that the data may have so many elements.
void check(const GltfMeshopt& view, Mode mode, const std::string& place,
           const SceneWriter& writer) {
  const uint64_t stride = view.byte_stride;
  const bool possible = mode == Mode::kAttributes ? stride >= 4 && stride <= 256 && stride % 4 == 0
                                                  : stride == 2 || stride == 4;
  if (!possible) {
    refuse(SOBB_ERROR_SCENE_SYNTAX, view, place, writer,
           "a byteStride of " + std::to_string(stride));
  }
  if (mode == Mode::kTriangles && view.count % kWholeTriangle != 0) {
    refuse(SOBB_ERROR_SCENE_SYNTAX, view, place, writer,
           std::to_string(view.count) + " indices are no whole triangles");
  }
  const uint64_t most = mode == Mode::kAttributes
                            ? view.byte_length * kMostVertexBytesPerByte / stride
                        : mode == Mode::kTriangles ? view.byte_length * kWholeTriangle
                                                   : view.byte_length;
  if (view.count > most) {
    refuse(SOBB_ERROR_SCENE_SYNTAX, view, place, writer,
           std::to_string(view.byte_length) + " bytes cannot hold " + std::to_string(view.count) +
               " elements");
  }
}

int decode(const GltfMeshopt& view, Mode mode, std::string_view data, std::string& to) {
  const auto* const from = reinterpret_cast<const unsigned char*>(data.data());
  const auto count = size_t(view.count);
  const auto stride = size_t(view.byte_stride);
  switch (mode) {
    case Mode::kAttributes:
      return meshopt_decodeVertexBuffer(to.data(), count, stride, from, data.size());
    case Mode::kTriangles:
      return meshopt_decodeIndexBuffer(to.data(), count, stride, from, data.size());
    case Mode::kIndices:
      return meshopt_decodeIndexSequence(to.data(), count, stride, from, data.size());
  }
  return -1;
}

void apply_filter(const GltfMeshopt& view, std::string& to, const std::string& place,
                  const SceneWriter& writer) {
  if (view.filter == "NONE") return;
  const auto count = size_t(view.count);
  const auto stride = size_t(view.byte_stride);
  if (view.filter == "EXPONENTIAL") {
    meshopt_decodeFilterExp(to.data(), count, stride);
  } else if (view.filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) {
    meshopt_decodeFilterOct(to.data(), count, stride);
  } else if (view.filter == "QUATERNION" && stride == 8) {
    meshopt_decodeFilterQuat(to.data(), count, stride);
  } else {
    refuse(SOBB_ERROR_SCENE_UNSUPPORTED, view, place, writer,
           "the filter " + view.filter.substr(0, 40) + " is not supported");
  }
}

}  // namespace

bool can_decode_meshopt() { return true; }

std::string decode_meshopt(const GltfMeshopt& view, std::string_view data, const std::string& place,
                           SceneWriter& writer) {
  const Mode mode = mode_of(view, place, writer);
  check(view, mode, place, writer);
  const uint64_t bytes = view.count * view.byte_stride;
  writer.work(bytes / 16);
  writer.hold(bytes);
  std::string result(size_t(bytes), '\0');
  const int error = decode(view, mode, data, result);
  if (error == -1) {
    refuse(SOBB_ERROR_SCENE_UNSUPPORTED, view, place, writer,
           "the data do not begin as a version of the encoding that this build reads");
  }
  if (error != 0) refuse(SOBB_ERROR_SCENE_SYNTAX, view, place, writer, "the data are malformed");
  if (mode == Mode::kAttributes) apply_filter(view, result, place, writer);
  return result;
}

#else

bool can_decode_meshopt() { return false; }

std::string decode_meshopt(const GltfMeshopt& view, std::string_view, const std::string& place,
                           SceneWriter& writer) {
  refuse(SOBB_ERROR_SCENE_UNSUPPORTED, view, place, writer,
         "this build has no libmeshoptimizer to decode it");
}

#endif

}  // namespace sobb
