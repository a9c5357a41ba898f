// SPDX-License-Identifier: Apache-2.0
// Lets loops run on more threads than the machine has cores, so that tests on a small machine see
// several.
#pragma once

#include <cstddef>

#ifdef SOBB_WITH_TBB
#include <oneapi/tbb/global_control.h>
#endif

namespace sobb::test {

// TBB keeps to the number of cores while none lives. The library's own threads have no such limit.
class MoreThreads {
 public:
#ifdef SOBB_WITH_TBB
  explicit MoreThreads(size_t threads)
      : limit_(tbb::global_control::max_allowed_parallelism, threads) {}

 private:
  tbb::global_control limit_;
#else
  explicit MoreThreads(size_t) {}
  ~MoreThreads() {}  // NOLINT(modernize-use-equals-default): a use of the variable
#endif
};

}  // namespace sobb::test
