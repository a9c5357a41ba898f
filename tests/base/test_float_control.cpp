// SPDX-License-Identifier: Apache-2.0
// FloatControl: the default word inside, the caller's back outside.
#include "base/float_control.h"

#include <gtest/gtest.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include <stdexcept>

namespace sobb {
namespace {

constexpr unsigned kDefault = 0x1F80;
constexpr unsigned kOdd = kDefault | _MM_ROUND_UP | _MM_FLUSH_ZERO_ON | _MM_DENORMALS_ZERO_ON;

class FloatControlTest : public testing::Test {
 protected:
  FloatControlTest() { _mm_setcsr(kOdd); }
  ~FloatControlTest() override { _mm_setcsr(found_); }

 private:
  unsigned found_ = _mm_getcsr();
};

TEST_F(FloatControlTest, SetsTheDefaultAndRestoresWhatItFound) {
  {
    const FloatControl control;
    EXPECT_EQ(_mm_getcsr(), kDefault);
  }
  EXPECT_EQ(_mm_getcsr(), kOdd);
}

TEST_F(FloatControlTest, RestoresWhenAnExceptionLeaves) {
  try {
    const FloatControl control;
    throw std::runtime_error("leaving");
  } catch (const std::runtime_error&) {
    EXPECT_EQ(_mm_getcsr(), kOdd);
  }
}

TEST_F(FloatControlTest, Nests) {
  const FloatControl outer;
  {
    const FloatControl inner;
    EXPECT_EQ(_mm_getcsr(), kDefault);
  }
  EXPECT_EQ(_mm_getcsr(), kDefault);
}

TEST_F(FloatControlTest, DenormalsAreKeptInside) {
  volatile float tiny = 1e-38f;
  volatile float flushed = tiny * 0.1f;
  EXPECT_EQ(flushed, 0.0f);
  const FloatControl control;
  volatile float kept = tiny * 0.1f;
  EXPECT_GT(kept, 0.0f);
}

}  // namespace
}  // namespace sobb
