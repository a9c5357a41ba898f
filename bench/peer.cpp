// SPDX-License-Identifier: Apache-2.0
// Loads the module that calls Embree, from where the program's libraries lie.
#include "peer.h"

#include <dlfcn.h>

#include <string>

namespace sobb::bench {
namespace {

struct LoadedModule {
  const PeerLibrary* library = nullptr;
  std::string error;

  LoadedModule() {
    void* module = dlopen("libsobb_bench_embree.so", RTLD_NOW | RTLD_LOCAL);
    void* function = module == nullptr ? nullptr : dlsym(module, "sobb_bench_peer_library");
    if (function == nullptr) {
      error = dlerror();
      return;
    }
    library = reinterpret_cast<const PeerLibrary* (*)()>(function)();
  }
};

const LoadedModule& loaded_module() {
  static const LoadedModule module;
  return module;
}

}  // namespace

const PeerLibrary* peer_library() { return loaded_module().library; }

const char* why_no_peer() { return loaded_module().error.c_str(); }

}  // namespace sobb::bench
