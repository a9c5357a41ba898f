// SPDX-License-Identifier: Apache-2.0
// See heap_watch.h.
#include "fuzz/heap_watch.h"

#include <algorithm>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SOBB_FUZZ_HAS_HOOKS
#endif
#endif

#ifdef SOBB_FUZZ_HAS_HOOKS
#include <sanitizer/allocator_interface.h>
#endif

namespace sobb::fuzz {
namespace {

thread_local bool watching = false;
thread_local int64_t held = 0;
thread_local int64_t most = 0;

#ifdef SOBB_FUZZ_HAS_HOOKS
void on_allocate(const volatile void*, size_t size) {
  if (!watching) return;
  held += static_cast<int64_t>(size);
  most = std::max(most, held);
}

void on_free(const volatile void* pointer) {
  if (!watching || pointer == nullptr) return;
  held -= static_cast<int64_t>(__sanitizer_get_allocated_size(const_cast<void*>(pointer)));
}

const int installed = __sanitizer_install_malloc_and_free_hooks(on_allocate, on_free);
#endif

}  // namespace

HeapWatch::HeapWatch() {
  held = 0;
  most = 0;
  watching = true;
}

HeapWatch::~HeapWatch() { watching = false; }

int64_t HeapWatch::peak() const { return most; }

}  // namespace sobb::fuzz
