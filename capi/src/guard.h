// SPDX-License-Identifier: Apache-2.0
// The C boundary: exceptions become a status and this thread's last error.
#pragma once

#include <cstddef>
#include <cstring>
#include <exception>
#include <new>

#include "base/error.h"
#include "base/float_control.h"
#include "sobb/sobb.h"

// Sets this thread's message. It lives in libsobb, so that libsobb_scene shares it.
extern "C" SOBB_API void sobb_internal_set_error(const char* message);

namespace sobb {

inline sobb_status report(sobb_status status, const char* message) {
  sobb_internal_set_error(message);
  return status;
}

// Runs `body` under the library's floating-point control word; its exceptions end here.
template <class Body>
sobb_status guard(Body&& body) noexcept {
  const FloatControl control;
  try {
    body();
    return SOBB_OK;
  } catch (const Error& error) {
    return report(error.status, error.what());
  } catch (const std::bad_alloc&) {
    return report(SOBB_ERROR_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return report(SOBB_ERROR_INTERNAL, error.what());
  } catch (...) {
    return report(SOBB_ERROR_INTERNAL, "unknown exception");
  }
}

// Fails where a pointer argument is NULL that may not be.
inline void require(const void* pointer, const char* name) {
  if (pointer == nullptr) fail(SOBB_ERROR_INVALID_ARGUMENT, "%s is NULL", name);
}

// Reads the caller's option struct as this library knows it: a member counts where the caller's
// struct_size covers it, the rest is zero. Bytes that this version does not know must be zero. NULL
// stands for all zero. Options begin with `uint32_t struct_size`.
template <class Options>
Options read_options(const Options* options, const char* name) {
  Options known{};
  if (options == nullptr) return known;
  uint32_t size = 0;
  std::memcpy(&size, options, sizeof size);
  if (size < sizeof size) {
    fail(SOBB_ERROR_INVALID_ARGUMENT, "%s: struct_size is %u", name, size);
  }
  const auto* bytes = reinterpret_cast<const unsigned char*>(options);
  for (size_t i = sizeof(Options); i < size; ++i) {
    if (bytes[i] != 0) {
      fail(SOBB_ERROR_INVALID_ARGUMENT, "%s: byte %zu is set, beyond what this library knows", name,
           i);
    }
  }
  std::memcpy(&known, options, size < sizeof(Options) ? size : sizeof(Options));
  return known;
}

// Hands an information struct to the caller, up to the size that the caller knows; struct_size
// stays.
template <class Info>
void write_info(const Info& known, Info* info, const char* name) {
  require(info, name);
  uint32_t size = 0;
  std::memcpy(&size, info, sizeof size);
  if (size < sizeof size) {
    fail(SOBB_ERROR_INVALID_ARGUMENT, "%s: struct_size is %u", name, size);
  }
  const size_t covered = size < sizeof(Info) ? size : sizeof(Info);
  std::memcpy(reinterpret_cast<unsigned char*>(info) + sizeof size,
              reinterpret_cast<const unsigned char*>(&known) + sizeof size, covered - sizeof size);
}

}  // namespace sobb
