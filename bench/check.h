// SPDX-License-Identifier: Apache-2.0
// The library's statuses as exceptions with the library's own message.
#pragma once

#include <stdexcept>

#include "sobb/sobb.h"

namespace sobb::bench {

inline void check(sobb_status status) {
  if (status != SOBB_OK) throw std::runtime_error(sobb_last_error());
}

}  // namespace sobb::bench
