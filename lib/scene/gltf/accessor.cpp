// SPDX-License-Identifier: Apache-2.0
// See accessor.h.
#include "scene/gltf/accessor.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <limits>

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

}  // namespace

void GltfAccessor::refuse(const char* format, ...) const {
  char cause[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(cause, sizeof cause, format, arguments);
  va_end(arguments);
  fail(SOBB_ERROR_SCENE_SYNTAX, "%s: accessors[%d] %s", name_.c_str(), index_, cause);
}

GltfAccessor::GltfAccessor(const GltfDocument& document, GltfBuffers& buffers, int index, Use use,
                           const std::string& name)
    : document_(document), buffers_(buffers), name_(name), index_(index) {
  if (index < 0 || size_t(index) >= document.model.accessors.size()) refuse("does not exist");
  const tinygltf::Accessor& accessor = document.model.accessors[size_t(index)];
  take_type(accessor, use);
  if (count_ == 0) refuse("has no elements");
  if (accessor.bufferView >= 0) {
    elements_ = range(accessor.bufferView, accessor.byteOffset, count_, element_size_);
  } else if (!buffers_.take_zeros(count_)) {
    refuse("has no bufferView for its %llu elements", static_cast<unsigned long long>(count_));
  }
  if (accessor.sparse.isSparse || accessor.bufferView < 0) make_dense(accessor);
}

void GltfAccessor::take_type(const tinygltf::Accessor& accessor, Use use) {
  component_type_ = accessor.componentType;
  normalized_ = accessor.normalized;
  count_ = accessor.count;
  if (use == Use::kIndices) {
    if (accessor.type != TINYGLTF_TYPE_SCALAR || !is_index_type(component_type_)) {
      refuse("is not of unsigned integers, as indices must be");
    }
    element_size_ = component_size(component_type_);
    return;
  }
  const bool possible = component_type_ == TINYGLTF_COMPONENT_TYPE_FLOAT ||
                        (document_.quantized && is_quantized_type(component_type_));
  if (accessor.type != TINYGLTF_TYPE_VEC3 || !possible) {
    refuse("is not of three floats, as positions must be");
  }
  element_size_ = 3 * component_size(component_type_);
}

// The `count` elements at `offset` of a buffer view, proven to lie in it.
GltfAccessor::Range GltfAccessor::range(int index, uint64_t offset, uint64_t count,
                                        uint64_t element_size) const {
  const auto& views = document_.model.bufferViews;
  if (index < 0 || size_t(index) >= views.size()) refuse("names no bufferView, %d", index);
  const tinygltf::BufferView& view = views[size_t(index)];
  if (view.buffer < 0 || size_t(view.buffer) >= buffers_.count()) {
    refuse("is in bufferViews[%d], which names no buffer, %d", index, view.buffer);
  }
  const std::string_view bytes = buffers_.bytes(size_t(view.buffer));
  if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset) {
    refuse("is in bufferViews[%d], which leaves its buffer", index);
  }
  const uint64_t stride = view.byteStride == 0 ? element_size : view.byteStride;
  if (stride < element_size)
    refuse("has elements larger than the stride of bufferViews[%d]", index);
  // offset + (count - 1) * stride + element_size <= byteLength, without overflow.
  const uint64_t length = view.byteLength;
  if (offset > length || element_size > length - offset ||
      count - 1 > (length - offset - element_size) / stride) {
    refuse("leaves bufferViews[%d]", index);
  }
  return {bytes.data() + view.byteOffset + offset, stride};
}

// Copies the elements, or zeros where there is no view, and puts the sparse ones in their places.
void GltfAccessor::make_dense(const tinygltf::Accessor& accessor) {
  buffers_.hold(count_ * element_size_);
  dense_.resize(size_t(count_ * element_size_));
  if (elements_.data != nullptr) {
    for (uint64_t i = 0; i < count_; ++i) {
      std::memcpy(&dense_[i * element_size_], elements_.data + i * elements_.stride, element_size_);
    }
  }
  elements_ = {dense_.data(), element_size_};
  if (!accessor.sparse.isSparse) return;

  const auto& sparse = accessor.sparse;
  const int type = sparse.indices.componentType;
  if (!is_index_type(type)) refuse("has sparse indices that are not unsigned integers");
  if (sparse.count < 1) refuse("is sparse without elements");
  const auto count = uint64_t(sparse.count);
  const Range places = range(sparse.indices.bufferView, uint64_t(sparse.indices.byteOffset), count,
                             component_size(type));
  const Range values =
      range(sparse.values.bufferView, uint64_t(sparse.values.byteOffset), count, element_size_);
  for (uint64_t i = 0; i < count; ++i) {
    const uint32_t place = load_index(places.data + i * places.stride, type);
    if (place >= count_) {
      refuse("replaces element %u of %llu", place, static_cast<unsigned long long>(count_));
    }
    std::memcpy(&dense_[place * element_size_], values.data + i * values.stride, element_size_);
  }
}

std::array<double, 3> GltfAccessor::position(uint64_t i) const {
  const char* from = elements_.data + i * elements_.stride;
  std::array<double, 3> result{};
  for (size_t k = 0; k < 3; ++k) {
    switch (component_type_) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        result[k] = load_quantized<int8_t>(from + k, normalized_);
        break;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        result[k] = load_quantized<uint8_t>(from + k, normalized_);
        break;
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        result[k] = load_quantized<int16_t>(from + 2 * k, normalized_);
        break;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        result[k] = load_quantized<uint16_t>(from + 2 * k, normalized_);
        break;
      default:
        result[k] = load_little<float>(from + 4 * k);
    }
  }
  return result;
}

uint32_t GltfAccessor::index(uint64_t i) const {
  return load_index(elements_.data + i * elements_.stride, component_type_);
}

}  // namespace sobb
