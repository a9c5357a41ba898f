// SPDX-License-Identifier: Apache-2.0
// What needs no hierarchy: names of statuses, the version, the instruction set.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <string>

#include "sobb/sobb.h"

namespace sobb::test {
namespace {

TEST(Status, HasAWordForEach) {
  std::set<std::string> words;
  const auto add_range = [&](int first, int last) {
    for (int status = first; status <= last; ++status) {
      words.insert(sobb_status_string(static_cast<sobb_status>(status)));
    }
  };
  add_range(SOBB_OK, SOBB_ERROR_INTERNAL);
  add_range(SOBB_ERROR_FILE_OPEN, SOBB_ERROR_FILE_WRITE);
  add_range(SOBB_ERROR_FORMAT_MAGIC, SOBB_ERROR_FORMAT_RECORD);
  add_range(SOBB_ERROR_SCENE_FORMAT, SOBB_ERROR_SCENE_REFERENCE);
  EXPECT_EQ(words.size(), 11U + 3 + 13 + 4);
  EXPECT_EQ(words.count("unknown status"), 0U);
  EXPECT_STREQ(sobb_status_string(static_cast<sobb_status>(11)), "unknown status");
}

TEST(Version, IsTheHeaders) {
  EXPECT_EQ(sobb_version(), static_cast<uint32_t>(SOBB_VERSION_MAJOR << 16 |
                                                  SOBB_VERSION_MINOR << 8 | SOBB_VERSION_PATCH));
}

class Isa : public testing::Test {
 protected:
  ~Isa() override {
    unsetenv("SOBB_ISA");
    if (!found_.empty()) setenv("SOBB_ISA", found_.c_str(), 1);
  }

  const std::string found_ = std::getenv("SOBB_ISA") == nullptr ? "" : std::getenv("SOBB_ISA");
};

TEST_F(Isa, IsTheEnvironmentsWhereTheCallerHasNoWish) {
  sobb_isa isa = SOBB_ISA_BEST;
  setenv("SOBB_ISA", "sse4", 1);
  EXPECT_EQ(sobb_resolve_isa(SOBB_ISA_BEST, &isa), SOBB_OK);
  EXPECT_EQ(isa, SOBB_ISA_SSE4);
  unsetenv("SOBB_ISA");
  sobb_isa best = SOBB_ISA_BEST;
  ASSERT_EQ(sobb_resolve_isa(SOBB_ISA_BEST, &best), SOBB_OK);
  EXPECT_NE(best, SOBB_ISA_BEST);
  setenv("SOBB_ISA", best == SOBB_ISA_AVX2 ? "avx2" : "sse4", 1);
  EXPECT_EQ(sobb_resolve_isa(SOBB_ISA_BEST, &isa), SOBB_OK);
  EXPECT_EQ(isa, best);
}

TEST_F(Isa, IsRefusedWhereItIsUnknown) {
  sobb_isa isa = SOBB_ISA_BEST;
  setenv("SOBB_ISA", "neon", 1);
  EXPECT_EQ(sobb_resolve_isa(SOBB_ISA_BEST, &isa), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_resolve_isa(static_cast<sobb_isa>(3), &isa), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_resolve_isa(SOBB_ISA_SSE4, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
}

}  // namespace
}  // namespace sobb::test
