// SPDX-License-Identifier: Apache-2.0
// What tests expect of failures inside the library.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "base/error.h"

namespace sobb::test {

// Expects that body() throws an Error with that status, whose message has `part`. Returns the
// message.
template <class Body>
std::string expect_failure(sobb_status status, const std::string& part, const Body& body) {
  try {
    body();
    ADD_FAILURE() << "no error, expected: " << part;
    return {};
  } catch (const Error& error) {
    std::string message = error.what();
    EXPECT_EQ(error.status, status) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
    return message;
  }
}

}  // namespace sobb::test
