// SPDX-License-Identifier: Apache-2.0
// check() throws a failed status of the library, with the library's own message.
#pragma once

#include <stdexcept>

#include "sobb/sobb.h"

namespace sobb::bench {

inline void check(sobb_status status) {
  if (status != SOBB_OK) throw std::runtime_error(sobb_last_error());
}

}  // namespace sobb::bench
