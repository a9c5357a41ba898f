// SPDX-License-Identifier: Apache-2.0
// The floating-point arithmetic that all results rest on: FloatControl sets the control word, and a
// compiler that may change the arithmetic is refused.
#pragma once

#include <xmmintrin.h>

#include <cfloat>

// CMake's build undoes what CMAKE_CXX_FLAGS asks for (cmake/SobbCompileOptions.cmake). GCC's
// __GCC_IEC_559 is 2 unless some part of -ffast-math is on; clang has macros for the whole only.
#if defined(__FAST_MATH__) || __FINITE_MATH_ONLY__ || \
    (defined(__GCC_IEC_559) && __GCC_IEC_559 < 2) || FLT_EVAL_METHOD != 0
#error "sobb needs IEEE 754 arithmetic: no -ffast-math, -Ofast, a part of them, or -mfpmath=387"
#endif

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
