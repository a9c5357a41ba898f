// SPDX-License-Identifier: Apache-2.0
#include "base/threads/workers.h"

#include <dlfcn.h>
#include <pthread.h>

#include <atomic>
#include <mutex>

namespace sobb {
namespace {

std::atomic<bool> gone{false};

// Keeps the shared object that has this code, and so TBB below it, in the process. Workers run its
// code, for a moment also the end of a loop's: a host that unloaded it would take the code from
// under them. They cannot be waited for, since the host may use TBB as well.
void stay_loaded() {
  static const char here = 0;
  Dl_info object;
  // A program itself is not found by its name, and nobody unloads it.
  if (dladdr(&here, &object) != 0 && object.dli_fname != nullptr) {
    dlopen(object.dli_fname, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
  }
}

}  // namespace

void prepare_for_workers() {
  static std::once_flag prepared;
  std::call_once(prepared, [] {
    stay_loaded();
    pthread_atfork(nullptr, nullptr, [] { gone = true; });
  });
}

bool workers_are_gone() { return gone; }

}  // namespace sobb
