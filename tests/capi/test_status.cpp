// SPDX-License-Identifier: Apache-2.0
// What needs no hierarchy: names of statuses, the version, the instruction set.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <string>

#include "sobb/sobb.h"
#include "support/supported_isas.h"

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
  unsetenv("SOBB_ISA");
  sobb_isa best = SOBB_ISA_BEST;
  ASSERT_EQ(sobb_resolve_isa(SOBB_ISA_BEST, &best), SOBB_OK);
  EXPECT_EQ(best, supported_isas().back());
  sobb_isa isa = SOBB_ISA_BEST;
  for (const sobb_isa named : supported_isas()) {
    setenv("SOBB_ISA", sobb_isa_name(named), 1);
    EXPECT_EQ(sobb_resolve_isa(SOBB_ISA_BEST, &isa), SOBB_OK);
    EXPECT_EQ(isa, named);
  }
  EXPECT_EQ(sobb_resolve_isa(SOBB_ISA_SSE4, &isa), SOBB_OK);
  EXPECT_EQ(isa, SOBB_ISA_SSE4) << "the caller's wish comes first";
  for (const char* none : {"best", ""}) {
    setenv("SOBB_ISA", none, 1);
    EXPECT_EQ(sobb_resolve_isa(SOBB_ISA_BEST, &isa), SOBB_OK);
    EXPECT_EQ(isa, best);
  }
}

TEST_F(Isa, IsRefusedWhereItIsUnknown) {
  sobb_isa isa = SOBB_ISA_BEST;
  setenv("SOBB_ISA", "mmx", 1);
  EXPECT_EQ(sobb_resolve_isa(SOBB_ISA_BEST, &isa), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(std::string(sobb_last_error()).find("environment: SOBB_ISA is mmx, not one of best, "),
            0U)
      << sobb_last_error();
  EXPECT_EQ(sobb_resolve_isa(static_cast<sobb_isa>(sobb_isa_count() + 1), &isa),
            SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(sobb_resolve_isa(SOBB_ISA_SSE4, nullptr), SOBB_ERROR_INVALID_ARGUMENT);
}

TEST_F(Isa, HasANameATitleAndAWayBack) {
  std::set<std::string> names;
  std::set<std::string> titles;
  for (uint32_t value = SOBB_ISA_BEST; value <= sobb_isa_count(); ++value) {
    names.insert(sobb_isa_name(value));
    titles.insert(sobb_isa_title(value));
    sobb_isa isa = SOBB_ISA_BEST;
    EXPECT_EQ(sobb_isa_from_name(sobb_isa_name(value), &isa), SOBB_OK);
    EXPECT_EQ(static_cast<uint32_t>(isa), value);
  }
  EXPECT_EQ(names.size(), sobb_isa_count() + 1);
  EXPECT_EQ(titles.size(), sobb_isa_count() + 1);
  EXPECT_EQ(names.count("unknown"), 0U);
  EXPECT_STREQ(sobb_isa_name(SOBB_ISA_BEST), "best");
  EXPECT_STREQ(sobb_isa_name(SOBB_ISA_SSE4), "sse4");
  EXPECT_STREQ(sobb_isa_name(SOBB_ISA_AVX2), "avx2");
  EXPECT_STREQ(sobb_isa_title(SOBB_ISA_SSE4), "SSE4.2");
  for (const uint32_t value : {sobb_isa_count() + 1, 0xFFFFFFFFU}) {
    EXPECT_STREQ(sobb_isa_name(value), "unknown");
    EXPECT_STREQ(sobb_isa_title(value), "unknown");
  }
}

TEST_F(Isa, OfAnUnknownNameIsRefused) {
  for (const char* name : {"unknown", "", "SSE4", "avx", "avx22", "avx2 "}) {
    sobb_isa isa = SOBB_ISA_SSE4;
    EXPECT_EQ(sobb_isa_from_name(name, &isa), SOBB_ERROR_INVALID_ARGUMENT) << name;
    EXPECT_EQ(isa, SOBB_ISA_SSE4) << "untouched";
  }
  EXPECT_EQ(sobb_isa_from_name("mmx", nullptr), SOBB_ERROR_INVALID_ARGUMENT);
  sobb_isa isa = SOBB_ISA_BEST;
  EXPECT_EQ(sobb_isa_from_name(nullptr, &isa), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(sobb_last_error(), "name is NULL");
}

}  // namespace
}  // namespace sobb::test
