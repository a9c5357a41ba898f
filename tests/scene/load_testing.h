// SPDX-License-Identifier: Apache-2.0
// What the tests that load files by their paths share.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "format/temporary_folder.h"
#include "scene/error_testing.h"
#include "scene/load.h"

namespace sobb::test {

// Gives each test a folder of its own.
class LoadingFiles : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name); }
  std::string write(const std::string& name, const std::string& bytes) const {
    return folder_.write(name, bytes);
  }

  static Scene load(const std::string& source, const char* views = nullptr) {
    return load_scene(source, views, 0);
  }
  static void expect_error(const std::string& source, sobb_status status, const std::string& part,
                           const char* views = nullptr, uint64_t limit = 0) {
    SCOPED_TRACE(source);
    expect_failure(status, part, [&] { load_scene(source, views, limit); });
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace sobb::test
