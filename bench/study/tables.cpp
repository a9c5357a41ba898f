// SPDX-License-Identifier: Apache-2.0
#include "study_options.h"

namespace sobb::study {

int tables(const StudyOptions& /*options*/) { return 1; }

}  // namespace sobb::study
