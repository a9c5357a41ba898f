// SPDX-License-Identifier: Apache-2.0
// Memory of one task of rays, whose end a sanitizer watches.
#pragma once

#include <cstddef>
#include <new>

namespace sobb::test {

class Scratch {
 public:
  explicit Scratch(size_t size) : bytes_(::operator new(size, kAlignment)) {}
  ~Scratch() { ::operator delete(bytes_, kAlignment); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  void* get() const { return bytes_; }

 private:
  static constexpr std::align_val_t kAlignment{64};
  void* bytes_;
};

}  // namespace sobb::test
