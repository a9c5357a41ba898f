// SPDX-License-Identifier: Apache-2.0
// See draco.h.
#include "scene/gltf/buffers/draco.h"

#include "base/error.h"

#ifdef SOBB_WITH_DRACO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wsign-compare"
#include <draco/compression/attributes/attributes_decoder_interface.h>
#include <draco/compression/decode.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#pragma GCC diagnostic pop

#include <cstring>
#include <exception>
#include <type_traits>

#include "scene/gltf/document/model.h"
#endif

namespace sobb {
namespace {

constexpr const char* kExtension = "KHR_draco_mesh_compression";

}  // namespace

#ifdef SOBB_WITH_DRACO

namespace {

// glTF's bitstream (KHR_draco_mesh_compression, "Conformance").
constexpr uint16_t kBitstream = DRACO_BITSTREAM_VERSION(2, 2);

// What libdraco takes at most, which has no limit of its own: per byte of the data, for the tables
// of its entropy decoder and for metadata, and once for a look-up table; per face; per face for
// each attribute that has a connectivity of its own; per point and attribute, beside the values,
// which it keeps as integers too.
constexpr uint64_t kTableBytesPerByte = 896;
constexpr uint64_t kLookUpBytes = 4 << 20;
constexpr uint64_t kFaceBytes = 320;
constexpr uint64_t kConnectivityBytes = 224;
constexpr uint64_t kPointBytes = 48;
constexpr uint64_t kIntegerBytes = 4;
constexpr uint64_t kMostWithoutLimit = uint64_t{4} << 30;

// Checks each stage of libdraco's decoders before it takes memory. An exception waits until the
// library's functions have returned.
class DracoStages {
 public:
  // `buffer` is the one that is decoded, of `data_bytes` bytes.
  DracoStages(const draco::DecoderBuffer& buffer, uint32_t position_id, uint64_t data_bytes,
              SceneWriter& writer)
      : buffer_(buffer), position_id_(position_id), data_bytes_(data_bytes), writer_(writer) {}

  // Each returns whether decoding may go on.
  bool may_connect_edgebreaker() {
    draco::DecoderBuffer next = buffer_;
    uint32_t vertices = 0;
    uint32_t faces = 0;
    uint8_t attributes = 0;
    return draco::DecodeVarint(&vertices, &next) && draco::DecodeVarint(&faces, &next) &&
           next.Decode(&attributes) && has_room(connectivity_bytes(faces, attributes));
  }
  bool may_connect_sequential() {
    draco::DecoderBuffer next = buffer_;
    uint32_t faces = 0;
    return draco::DecodeVarint(&faces, &next) && has_room(connectivity_bytes(faces, 0));
  }
  bool may_decode(const draco::PointCloud& cloud, const draco::AttributesDecoderInterface& part) {
    for (int32_t i = 0; i < part.GetNumAttributes(); ++i) {
      const draco::PointAttribute& attribute = *cloud.attribute(part.GetAttributeId(i));
      const uint64_t components = uint64_t(attribute.num_components());
      const uint64_t bytes = uint64_t(attribute.byte_stride()) + components * kIntegerBytes;
      value_bytes_ += uint64_t(cloud.num_points()) * (kPointBytes + bytes);
    }
    return has_room(connectivity_bytes_ + value_bytes_);
  }
  bool has_positions(const draco::PointCloud& cloud,
                     const draco::AttributesDecoderInterface& part) const {
    const int32_t wanted = cloud.GetAttributeIdByUniqueId(position_id_);
    for (int32_t i = 0; i < part.GetNumAttributes(); ++i) {
      if (part.GetAttributeId(i) == wanted) return true;
    }
    return false;
  }
  // Predicting texture coordinates reads a length that libdraco does not check. Encoders never code
  // them as one with positions, nor before. (The method is the last but one byte read.)
  bool may_predict() {
    const int method = static_cast<uint8_t>(buffer_.data_head()[-2]);
    if (method != draco::MESH_PREDICTION_TEX_COORDS_PORTABLE &&
        method != draco::MESH_PREDICTION_TEX_COORDS_DEPRECATED) {
      return true;
    }
    predicts_texture_ = true;
    return false;
  }

  // Throws what a check threw. Returns whether none has failed.
  bool succeeded() const {
    if (error_) std::rethrow_exception(error_);
    return !predicts_texture_;
  }

 private:
  uint64_t connectivity_bytes(uint64_t faces, uint64_t attributes) {
    return connectivity_bytes_ = faces * (kFaceBytes + attributes * kConnectivityBytes);
  }
  bool has_room(uint64_t bytes) {
    const uint64_t tables = kTableBytesPerByte * data_bytes_ + kLookUpBytes;
    try {
      check_decoding_room(writer_.has_limit() ? tables + bytes : bytes);
      return true;
    } catch (const Error&) {
      error_ = std::current_exception();
      return false;
    }
  }

  // Without a limit, a small file shall not ask for more than JSON may.
  void check_decoding_room(uint64_t bytes) const {
    if (!writer_.has_limit() && bytes > kMostWithoutLimit) {
      fail(SOBB_ERROR_MEMORY_LIMIT,
           "%s: libdraco may take %llu bytes, more than the 4 GiB that it has without a memory "
           "limit",
           writer_.name().c_str(), static_cast<unsigned long long>(bytes));
    }
    writer_.check_room(bytes);
  }

  const draco::DecoderBuffer& buffer_;
  uint32_t position_id_;
  uint64_t data_bytes_;
  SceneWriter& writer_;
  uint64_t connectivity_bytes_ = 0;
  uint64_t value_bytes_ = 0;
  bool predicts_texture_ = false;
  std::exception_ptr error_;
};

// A decoder of libdraco that stops before a stage may take too much, and once it has the positions.
template <class Decoder>
class CheckedDecoder final : public Decoder {
 public:
  explicit CheckedDecoder(DracoStages& stages) : stages_(stages) {}

  const draco::MeshAttributeIndicesEncodingData* GetAttributeEncodingData(
      int attribute) const override {
    return stages_.may_predict() ? Decoder::GetAttributeEncodingData(attribute) : nullptr;
  }

 protected:
  bool DecodeConnectivity() override {
    constexpr bool kEdgebreaker = std::is_same_v<Decoder, draco::MeshEdgebreakerDecoder>;
    return (kEdgebreaker ? stages_.may_connect_edgebreaker() : stages_.may_connect_sequential()) &&
           Decoder::DecodeConnectivity();
  }
  bool DecodeAllAttributes() override {
    const draco::PointCloud& cloud = *this->point_cloud();
    for (int32_t i = 0; i < this->num_attributes_decoders(); ++i) {
      // The base class gives its decoders out as const, and has no other way to run some of them.
      auto& part = const_cast<draco::AttributesDecoderInterface&>(*this->attributes_decoder(i));
      if (!stages_.may_decode(cloud, part) || !part.DecodeAttributes(this->buffer())) return false;
      if (stages_.has_positions(cloud, part)) return true;
    }
    return false;
  }

 private:
  DracoStages& stages_;
};

template <class Decoder>
bool decode_mesh(draco::DecoderBuffer& buffer, DracoStages& stages, draco::Mesh& mesh) {
  const draco::DecoderOptions options;
  return CheckedDecoder<Decoder>(stages).Decode(options, &buffer, &mesh).ok();
}

// The component type of glTF; 0 where an attribute cannot be positions.
int component_type(const draco::PointAttribute* attribute) {
  if (attribute == nullptr || attribute->num_components() != 3) return 0;
  switch (attribute->data_type()) {
    case draco::DT_INT8:
      return TINYGLTF_COMPONENT_TYPE_BYTE;
    case draco::DT_UINT8:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    case draco::DT_INT16:
      return TINYGLTF_COMPONENT_TYPE_SHORT;
    case draco::DT_UINT16:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    case draco::DT_FLOAT32:
      return TINYGLTF_COMPONENT_TYPE_FLOAT;
    default:
      return 0;
  }
}

// Copies the values of all points. Returns false where a point has none.
bool copy_points(const draco::PointAttribute& attribute, std::string& to) {
  const auto size = uint64_t(draco::DataTypeLength(attribute.data_type())) * 3;
  if (uint64_t(attribute.byte_stride()) != size) return false;
  const uint64_t values = attribute.buffer()->data_size() / size;
  const uint64_t points = to.size() / size;
  for (uint64_t i = 0; i < points; ++i) {
    const auto value = attribute.mapped_index(draco::PointIndex(uint32_t(i)));
    if (value.value() >= values) return false;
    attribute.GetValue(value, &to[i * size]);
  }
  return true;
}

void copy_indices(const draco::Mesh& mesh, std::string& to) {
  size_t at = 0;
  for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face) {
    for (const draco::PointIndex& corner : mesh.face(face)) {
      const uint32_t index = corner.value();
      std::memcpy(&to[at], &index, sizeof index);
      at += sizeof index;
    }
  }
}

// Decodes the bytes. Returns false where they are not a mesh of Draco's as glTF has them.
bool decode_checked(std::string_view data, DracoStages& stages, draco::DecoderBuffer& buffer,
                    draco::Mesh& mesh) {
  buffer.Init(data.data(), data.size());
  draco::DecoderBuffer header_buffer = buffer;
  draco::DracoHeader header;
  if (!draco::PointCloudDecoder::DecodeHeader(&header_buffer, &header).ok() ||
      DRACO_BITSTREAM_VERSION(header.version_major, header.version_minor) != kBitstream ||
      header.encoder_type != draco::TRIANGULAR_MESH) {
    return false;
  }
  const bool edgebreaker = header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING;
  const bool decoded = edgebreaker
                           ? decode_mesh<draco::MeshEdgebreakerDecoder>(buffer, stages, mesh)
                           : decode_mesh<draco::MeshSequentialDecoder>(buffer, stages, mesh);
  return stages.succeeded() && decoded;
}

}  // namespace

bool can_decode_draco() { return true; }

DracoTriangles decode_draco(std::string_view data, uint32_t position_id, const std::string& place,
                            SceneWriter& writer) {
  const auto refuse = [&](const char* cause) {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: %s: %s: %s", writer.name().c_str(), place.c_str(),
         kExtension, cause);
  };
  draco::DecoderBuffer buffer;
  draco::Mesh mesh;
  DracoStages stages(buffer, position_id, data.size(), writer);
  if (!decode_checked(data, stages, buffer, mesh)) refuse("the data are no mesh of Draco 2.2");
  const draco::PointAttribute* const positions = mesh.GetAttributeByUniqueId(position_id);
  DracoTriangles result;
  result.component_type = component_type(positions);
  if (result.component_type == 0) refuse("the data have no positions of three numbers");
  result.point_count = mesh.num_points();
  result.triangle_count = mesh.num_faces();
  const uint64_t position_bytes = 3 * uint64_t(draco::DataTypeLength(positions->data_type()));
  writer.work(result.point_count + result.triangle_count);
  writer.hold(result.point_count * position_bytes + result.triangle_count * 3 * sizeof(uint32_t));
  result.positions.resize(size_t(result.point_count * position_bytes));
  result.indices.resize(size_t(result.triangle_count * 3 * sizeof(uint32_t)));
  if (!copy_points(*positions, result.positions)) refuse("a point has no position");
  copy_indices(mesh, result.indices);
  return result;
}

#else

bool can_decode_draco() { return false; }

DracoTriangles decode_draco(std::string_view, uint32_t, const std::string& place,
                            SceneWriter& writer) {
  fail(SOBB_ERROR_SCENE_UNSUPPORTED, "%s: %s: %s: this build has no libdraco to decode it",
       writer.name().c_str(), place.c_str(), kExtension);
}

#endif

}  // namespace sobb
