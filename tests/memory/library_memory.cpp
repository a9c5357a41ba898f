// SPDX-License-Identifier: Apache-2.0
#include "memory/library_memory.h"

#include <dlfcn.h>
#include <execinfo.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>

namespace sobb::test {
namespace {

std::atomic<LibraryMemory*> counting{nullptr};

// Before each block that operator new gives: whom it counts for.
struct Header {
  LibraryMemory* owner;  // null where none
  uint64_t size;
};
constexpr size_t kHeaderSize = kNewAlignment;

// The file of the program or library that a return address lies in.
std::string_view module_of(const void* address) {
  Dl_info info;
  if (dladdr(address, &info) == 0 || info.dli_fname == nullptr) return {};
  const std::string_view path = info.dli_fname;
  return path.substr(path.rfind('/') + 1);
}

// Tells whether the library asks for memory, or one that reads a scene for it. That is the first on
// the stack besides this program, whose operator new it is, and the standard library.
bool library_asks() {
  static thread_local bool asking = false;  // the unwinder may allocate
  if (asking) return false;
  asking = true;
  void* frames[24];
  const int count = backtrace(frames, 24);
  const std::string_view own = module_of(reinterpret_cast<const void*>(&library_asks));
  bool ours = false;
  for (int i = 0; i < count; ++i) {
    const std::string_view module = module_of(frames[i]);
    if (module == own || module.starts_with("libstdc++")) continue;
    ours = module.starts_with("libsobb") || module.starts_with("libtinygltf") ||
           module.starts_with("libOpenMesh");
    break;
  }
  asking = false;
  return ours;
}

}  // namespace

void* new_block(size_t size) noexcept {
  LibraryMemory* owner = counting;
  if (owner != nullptr && !library_asks()) owner = nullptr;
  if (owner != nullptr && owner->refuses()) return nullptr;
  void* const block = std::aligned_alloc(
      kHeaderSize, (kHeaderSize + size + kHeaderSize - 1) / kHeaderSize * kHeaderSize);
  if (block == nullptr) return nullptr;
  new (block) Header{owner, size};
  if (owner != nullptr) owner->by_new.take(size);
  return static_cast<char*>(block) + kHeaderSize;
}

void delete_block(void* pointer) noexcept {
  if (pointer == nullptr) return;
  void* const block = static_cast<char*>(pointer) - kHeaderSize;
  const Header header = *static_cast<Header*>(block);
  if (header.owner != nullptr && header.owner == counting) {
    header.owner->by_new.give_back(header.size);
  }
  std::free(block);
}

void Holdings::take(uint64_t size) {
  ++calls;
  ++blocks;
  const uint64_t now = bytes += size;
  uint64_t seen = peak;
  while (now > seen && !peak.compare_exchange_weak(seen, now)) {
  }
}

void Holdings::give_back(uint64_t size) {
  --blocks;
  bytes -= size;
}

LibraryMemory::LibraryMemory(uint64_t fail_at) : fail_at_(fail_at) {
  void* frame;
  backtrace(&frame, 1);  // loads what it needs
  counting = this;
}

LibraryMemory::~LibraryMemory() { counting = nullptr; }

void* LibraryMemory::allocate(void* user, size_t size, size_t alignment) {
  auto* self = static_cast<LibraryMemory*>(user);
  if (self->refuses()) return nullptr;
  void* block = nullptr;
  if (posix_memalign(&block, std::max(alignment, sizeof(void*)), size) != 0) return nullptr;
  self->through_allocator.take(size);
  return block;
}

void LibraryMemory::deallocate(void* user, void* pointer, size_t size, size_t) {
  static_cast<LibraryMemory*>(user)->through_allocator.give_back(size);
  std::free(pointer);
}

}  // namespace sobb::test
