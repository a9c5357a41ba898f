// SPDX-License-Identifier: Apache-2.0
// collapse_sharing() finds wide nodes of the least cost where one basis bounds all children of a
// node. The collapse of exact_collapse.h ignores that.
#pragma once

#include "study/binary/area_measure.h"
#include "study/wide/exact_collapse.h"

namespace sobb::study {

// Runs the dynamic programming of exact_collapse.h anew for every node at which a wide one may
// begin, with areas in the basis of that node. The basis is the cheaper of two: the axes, and the
// best basis for the children that opening the largest would give.
WideCut collapse_sharing(const BinaryTree& tree, const AreaMeasure& measure, Leaves leaves);

}  // namespace sobb::study
