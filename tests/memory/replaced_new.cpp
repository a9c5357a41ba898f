// SPDX-License-Identifier: Apache-2.0
// The program's operator new, which the libraries use too. A sanitizer brings its own: there what
// the library takes by operator new is not seen, and does not fail.
#include <new>

#include "memory/library_memory.h"

#ifndef SOBB_SANITIZED

void* operator new(size_t size) {
  void* const block = sobb::test::new_block(size);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}
void* operator new[](size_t size) { return operator new(size); }
void* operator new(size_t size, const std::nothrow_t&) noexcept {
  return sobb::test::new_block(size);
}
void* operator new[](size_t size, const std::nothrow_t&) noexcept {
  return sobb::test::new_block(size);
}
// new_block() aligns as far as the library and its tests ask.
void* operator new(size_t size, std::align_val_t alignment) {
  return static_cast<size_t>(alignment) <= sobb::test::kNewAlignment ? operator new(size)
                                                                     : throw std::bad_alloc();
}
void operator delete(void* pointer, std::align_val_t) noexcept { operator delete(pointer); }
void operator delete(void* pointer, size_t, std::align_val_t) noexcept { operator delete(pointer); }
void operator delete(void* pointer) noexcept { sobb::test::delete_block(pointer); }
void operator delete[](void* pointer) noexcept { sobb::test::delete_block(pointer); }
void operator delete(void* pointer, size_t) noexcept { sobb::test::delete_block(pointer); }
void operator delete[](void* pointer, size_t) noexcept { sobb::test::delete_block(pointer); }
void operator delete(void* pointer, const std::nothrow_t&) noexcept {
  sobb::test::delete_block(pointer);
}
void operator delete[](void* pointer, const std::nothrow_t&) noexcept {
  sobb::test::delete_block(pointer);
}

#endif
