// SPDX-License-Identifier: Apache-2.0
// Wide nodes of the least cost where all children of a node are bounded in one basis, as the
// library bounds them: what exact_collapse.h knows nothing of.
#pragma once

#include "study/binary/area_measure.h"
#include "study/wide/exact_collapse.h"

namespace sobb::study {

// By dynamic programming as in exact_collapse.h, anew for every node that a wide one may begin at:
// within it areas are those in its basis. That is the axes or the best basis for the children that
// opening the largest would give, whichever is cheaper.
WideCut collapse_sharing(const BinaryTree& tree, const AreaMeasure& measure, Leaves leaves);

}  // namespace sobb::study
