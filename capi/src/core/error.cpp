// SPDX-License-Identifier: Apache-2.0
// Status names, each thread's last error, the version.
#include <cstdio>

#include "guard.h"
#include "sobb/sobb.h"

namespace {

// The storage is plain: setting a message never allocates, so that it can report that memory ran
// out.
thread_local char last_error[sobb::kLongestMessage] = "";

}  // namespace

extern "C" {

void sobb_internal_set_error(const char* message) {
  std::snprintf(last_error, sizeof last_error, "%s", message);
}

const char* sobb_last_error(void) { return last_error; }

uint32_t sobb_version(void) {
  return SOBB_VERSION_MAJOR << 16 | SOBB_VERSION_MINOR << 8 | SOBB_VERSION_PATCH;
}

const char* sobb_status_string(sobb_status status) {
  switch (status) {
    case SOBB_OK:
      return "success";
    case SOBB_ERROR_INVALID_ARGUMENT:
      return "invalid argument";
    case SOBB_ERROR_EMPTY:
      return "no triangles";
    case SOBB_ERROR_INDEX:
      return "vertex index out of range";
    case SOBB_ERROR_NOT_FINITE:
      return "coordinate not finite";
    case SOBB_ERROR_TOO_LARGE:
      return "coordinate or count too large";
    case SOBB_ERROR_OUT_OF_MEMORY:
      return "out of memory";
    case SOBB_ERROR_MEMORY_LIMIT:
      return "memory limit exceeded";
    case SOBB_ERROR_CANCELLED:
      return "cancelled";
    case SOBB_ERROR_UNSUPPORTED_CPU:
      return "instruction set not supported";
    case SOBB_ERROR_INTERNAL:
      return "internal error";
    case SOBB_ERROR_FILE_OPEN:
      return "file cannot be opened";
    case SOBB_ERROR_FILE_READ:
      return "file cannot be read";
    case SOBB_ERROR_FILE_WRITE:
      return "file cannot be written";
    case SOBB_ERROR_FORMAT_MAGIC:
      return "not a .sobb file";
    case SOBB_ERROR_FORMAT_VERSION:
      return "format version not supported";
    case SOBB_ERROR_FORMAT_FEATURE:
      return "format feature not supported";
    case SOBB_ERROR_FORMAT_SIZE:
      return "file size differs from its header";
    case SOBB_ERROR_FORMAT_HEADER:
      return "damaged header";
    case SOBB_ERROR_FORMAT_SECTION:
      return "damaged section table";
    case SOBB_ERROR_FORMAT_CHECKSUM:
      return "checksum differs";
    case SOBB_ERROR_FORMAT_TABLE:
      return "damaged direction table";
    case SOBB_ERROR_FORMAT_NODE:
      return "damaged node";
    case SOBB_ERROR_FORMAT_REFERENCE:
      return "damaged reference";
    case SOBB_ERROR_FORMAT_DEPTH:
      return "hierarchy too deep";
    case SOBB_ERROR_FORMAT_TRIANGLE:
      return "damaged triangle block";
    case SOBB_ERROR_FORMAT_RECORD:
      return "damaged build record";
    case SOBB_ERROR_SCENE_FORMAT:
      return "unknown scene format";
    case SOBB_ERROR_SCENE_SYNTAX:
      return "malformed scene";
    case SOBB_ERROR_SCENE_UNSUPPORTED:
      return "scene feature not supported";
    case SOBB_ERROR_SCENE_REFERENCE:
      return "scene refers to a missing file";
  }
  return "unknown status";
}

}  // extern "C"
