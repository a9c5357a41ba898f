// SPDX-License-Identifier: Apache-2.0
// See accessor.h.
#include "scene/gltf/accessor.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <limits>
#include <utility>

#include "base/error.h"
#include "scene/input/load_bytes.h"

namespace sobb {
namespace {

uint64_t component_size(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    default:
      return 4;
  }
}

bool is_index_type(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

bool is_quantized_type(int type) {
  return type >= TINYGLTF_COMPONENT_TYPE_BYTE && type <= TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
}

uint32_t load_index(const char* from, int type) {
  if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return load_little<uint8_t>(from);
  if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return load_little<uint16_t>(from);
  return load_little<uint32_t>(from);
}

// Loads an integer component, normalised as section 3.11 of the specification says.
template <class T>
double load_quantized(const char* from, bool normalized) {
  const double value = load_little<T>(from);
  if (!normalized) return value;
  return std::max(value / std::numeric_limits<T>::max(), -1.0);
}

// Elements `stride` bytes apart.
struct Range {
  const char* data = nullptr;
  uint64_t stride = 0;
};

// Makes the elements of one accessor.
class AccessorReader {
 public:
  using Use = GltfAccessor::Use;

  AccessorReader(const GltfDocument& document, GltfBuffers& buffers, int index, Use use)
      : document_(document), buffers_(buffers), index_(index), use_(use) {}

  GltfElements elements(uint64_t expected) {
    if (index_ < 0 || size_t(index_) >= document_.model.accessors.size()) refuse("does not exist");
    document_.faults.check(GltfItem::kAccessor, size_t(index_), buffers_.writer().name());
    const tinygltf::Accessor& accessor = document_.model.accessors[size_t(index_)];
    result_.count = accessor.count;
    result_.component_type = accessor.componentType;
    result_.normalized = accessor.normalized;
    check_type(accessor);
    if (result_.count == 0) refuse("has no elements");
    if (use_ == Use::kDisplacements && result_.count != expected) {
      refuse("displaces %llu vertices of %llu", static_cast<unsigned long long>(result_.count),
             static_cast<unsigned long long>(expected));
    }
    take_elements(accessor);
    return std::move(result_);
  }

 private:
  [[noreturn]] void refuse(const char* format, ...) const __attribute__((format(printf, 2, 3)));

  bool has_view(int view) const { return view >= 0 && size_t(view) < document_.views.size(); }

  void check_type(const tinygltf::Accessor& accessor);
  void take_elements(const tinygltf::Accessor& accessor);
  void make_dense(Range base);
  void substitute(const tinygltf::Accessor& accessor);
  Range range(int view, uint64_t offset, uint64_t count, uint64_t element_size) const;

  const GltfDocument& document_;
  GltfBuffers& buffers_;
  int index_;
  Use use_;
  uint64_t element_size_ = 0;
  GltfElements result_;
};

void AccessorReader::refuse(const char* format, ...) const {
  char cause[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(cause, sizeof cause, format, arguments);
  va_end(arguments);
  fail(SOBB_ERROR_SCENE_SYNTAX, "%s: accessors[%d] %s", buffers_.writer().name().c_str(), index_,
       cause);
}

void AccessorReader::check_type(const tinygltf::Accessor& accessor) {
  const int type = accessor.componentType;
  if (use_ == Use::kIndices) {
    if (accessor.type != TINYGLTF_TYPE_SCALAR || !is_index_type(type)) {
      refuse("is not of unsigned integers, as indices must be");
    }
    element_size_ = component_size(type);
    return;
  }
  const bool possible =
      type == TINYGLTF_COMPONENT_TYPE_FLOAT || (document_.quantized && is_quantized_type(type));
  if (accessor.type != TINYGLTF_TYPE_VEC3 || !possible) {
    refuse("is not of three floats, as positions must be");
  }
  element_size_ = 3 * component_size(type);
}

void AccessorReader::take_elements(const tinygltf::Accessor& accessor) {
  Range base;
  if (has_view(accessor.bufferView)) {
    base = range(accessor.bufferView, accessor.byteOffset, result_.count, element_size_);
  } else if (use_ != Use::kDisplacements && !buffers_.take_zeros(result_.count)) {
    refuse("has no bufferView for its %llu elements",
           static_cast<unsigned long long>(result_.count));
  }
  result_.data = base.data;
  result_.stride = base.stride;
  if (accessor.sparse.isSparse || base.data == nullptr) make_dense(base);
  if (accessor.sparse.isSparse) substitute(accessor);
}

// Copies the elements, or zeros where there is no view. Displacements are not held: they are gone
// before anything else is taken.
void AccessorReader::make_dense(Range base) {
  const uint64_t bytes = result_.count * element_size_;
  SceneWriter& writer = buffers_.writer();
  writer.check_room(bytes);
  if (use_ != Use::kDisplacements) writer.hold(bytes);
  writer.work(bytes / 16);
  std::string& dense = result_.owned;
  dense.resize(size_t(bytes));
  if (base.data != nullptr) {
    for (uint64_t i = 0; i < result_.count; ++i) {
      std::memcpy(&dense[i * element_size_], base.data + i * base.stride, element_size_);
    }
  }
  result_.data = nullptr;
  result_.stride = element_size_;
}

// Puts the sparse elements in their places.
void AccessorReader::substitute(const tinygltf::Accessor& accessor) {
  const auto& sparse = accessor.sparse;
  const int type = sparse.indices.componentType;
  if (!is_index_type(type)) refuse("has sparse indices that are not unsigned integers");
  if (sparse.count < 1) refuse("is sparse without elements");
  const auto count = uint64_t(sparse.count);
  const Range places = range(sparse.indices.bufferView, uint64_t(sparse.indices.byteOffset), count,
                             component_size(type));
  const Range values =
      range(sparse.values.bufferView, uint64_t(sparse.values.byteOffset), count, element_size_);
  buffers_.writer().work(count / 8);
  for (uint64_t i = 0; i < count; ++i) {
    const uint32_t place = load_index(places.data + i * places.stride, type);
    if (place >= result_.count) {
      refuse("replaces element %u of %llu", place, static_cast<unsigned long long>(result_.count));
    }
    std::memcpy(&result_.owned[place * element_size_], values.data + i * values.stride,
                element_size_);
  }
}

// The `count` elements at `offset` of a buffer view, proven to lie in it.
Range AccessorReader::range(int view, uint64_t offset, uint64_t count,
                            uint64_t element_size) const {
  if (!has_view(view)) refuse("names no bufferView, %d", view);
  const GltfBuffers::View bytes = buffers_.view(size_t(view));
  const uint64_t stride = bytes.stride == 0 ? element_size : bytes.stride;
  if (stride < element_size) refuse("has elements larger than the stride of bufferViews[%d]", view);
  // offset + (count - 1) * stride + element_size <= length, without overflow.
  const uint64_t length = bytes.bytes.size();
  if (offset > length || element_size > length - offset ||
      count - 1 > (length - offset - element_size) / stride) {
    refuse("leaves bufferViews[%d]", view);
  }
  return {bytes.bytes.data() + offset, stride};
}

}  // namespace

GltfAccessor GltfAccessor::read(const GltfDocument& document, GltfBuffers& buffers, int index,
                                Use use, uint64_t expected) {
  return GltfAccessor(AccessorReader(document, buffers, index, use).elements(expected));
}

std::array<double, 3> GltfAccessor::position(uint64_t i) const {
  const char* from = element(i);
  const bool normalized = elements_.normalized;
  std::array<double, 3> result{};
  for (size_t k = 0; k < 3; ++k) {
    switch (elements_.component_type) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        result[k] = load_quantized<int8_t>(from + k, normalized);
        break;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        result[k] = load_quantized<uint8_t>(from + k, normalized);
        break;
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        result[k] = load_quantized<int16_t>(from + 2 * k, normalized);
        break;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        result[k] = load_quantized<uint16_t>(from + 2 * k, normalized);
        break;
      default:
        result[k] = load_little<float>(from + 4 * k);
    }
  }
  return result;
}

uint32_t GltfAccessor::index(uint64_t i) const {
  return load_index(element(i), elements_.component_type);
}

}  // namespace sobb
