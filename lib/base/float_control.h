// SPDX-License-Identifier: Apache-2.0
// FloatControl sets the floating-point control word that all results rest on.
#pragma once

#include <xmmintrin.h>

namespace sobb {

// While one lives on a thread, results are rounded to nearest, denormals are kept and exceptions
// are masked. It restores what it found.
class FloatControl {
 public:
  FloatControl() : found_(_mm_getcsr()) {
    if (differs()) _mm_setcsr(kDefault);
  }
  ~FloatControl() {
    if (differs()) _mm_setcsr(found_);
  }
  FloatControl(const FloatControl&) = delete;
  FloatControl& operator=(const FloatControl&) = delete;

 private:
  bool differs() const { return (found_ & ~kFlags) != kDefault; }

  static constexpr unsigned kFlags = 0x3F;  // what has happened, not what is to
  static constexpr unsigned kDefault = 0x1F80;
  unsigned found_;
};

}  // namespace sobb
