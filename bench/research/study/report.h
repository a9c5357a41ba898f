// SPDX-License-Identifier: Apache-2.0
// The JSON that a question's answer is: what it was asked with, and figures by scene.
#pragma once

#include <nlohmann/json.hpp>

#include "study/study_options.h"

namespace sobb::study {

using Json = nlohmann::ordered_json;

// Writes {"question", "sobb", "processor", "scenes"} to options.out or to standard output.
void write_report(const StudyOptions& options, const char* question, const Json& scenes);

// A number with six digits: more would be noise in a committed file.
double rounded(double value);

}  // namespace sobb::study
