// SPDX-License-Identifier: Apache-2.0
// All the ways to trace an array of rays, beside the oracle.
#pragma once

#include <string>
#include <vector>

#include "capi/handles.h"

namespace sobb::test {

// Expects the oracle's bits from arrays with either instruction set, coherent or not, from packets
// and from single rays, for closest and any hits.
void check_calls(const HierarchyHandle& hierarchy, const std::vector<sobb_ray>& rays,
                 const std::vector<sobb_hit>& expected, const std::string& what);

}  // namespace sobb::test
