// SPDX-License-Identifier: Apache-2.0
// The answer to a question is JSON: what was asked with which program, and figures by scene.
#pragma once

#include <nlohmann/json.hpp>

#include "study/study_options.h"

namespace sobb::study {

using Json = nlohmann::ordered_json;

// Writes {"question", "sobb", "processor", "scenes"} to options.out or to standard output.
void write_report(const StudyOptions& options, const char* question, const Json& scenes);

// Rounds to six digits: more would be noise in a committed file.
double rounded(double value);

}  // namespace sobb::study
