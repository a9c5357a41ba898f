// SPDX-License-Identifier: Apache-2.0
// Error is a failure inside the library: a status, and a message that names the place and the
// cause.
#pragma once

#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "sobb/sobb.h"

namespace sobb {

// Every stage throws it, the C boundary catches it (capi/src/guard.h); it never goes beyond that.
class Error : public std::runtime_error {
 public:
  Error(sobb_status status, const std::string& message)
      : std::runtime_error(message), status(status) {}

  sobb_status status;
};

// A message has room for the longest path and what is wrong with it.
inline constexpr size_t kLongestMessage = 4096 + 512;

// Throws an Error with a printf-style message.
[[noreturn]] __attribute__((format(printf, 2, 3))) inline void fail(sobb_status status,
                                                                    const char* format, ...) {
  char message[kLongestMessage];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(message, sizeof message, format, arguments);
  va_end(arguments);
  throw Error(status, message);
}

}  // namespace sobb
