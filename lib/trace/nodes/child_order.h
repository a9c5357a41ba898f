// SPDX-License-Identifier: Apache-2.0
// The order in which a traversal visits the children that a ray meets.
#pragma once

#include <hwy/base.h>

namespace sobb {

// Makes room for a child among those from `base` to `top`, of which the nearest is on top: moves up
// those that is_nearer(item) says are nearer, and returns the place below them. An insertion sort:
// mostly two children are met.
template <class Item, class IsNearer>
HWY_INLINE Item* make_room(Item* base, Item* top, IsNearer is_nearer) {
  for (; top != base && is_nearer(top[-1]); --top) *top = top[-1];
  return top;
}

}  // namespace sobb
