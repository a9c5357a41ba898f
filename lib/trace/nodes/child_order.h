// SPDX-License-Identifier: Apache-2.0
// The order in which a traversal visits the children that a ray meets.
#pragma once

#include <hwy/base.h>

namespace sobb {

// Pushes an item among those from `base` on, of which the nearest is on top. An insertion sort:
// mostly two children are met. `nearer(a, b)` says whether a, on the stack, is to be visited before
// b.
template <class Item, class Nearer>
HWY_INLINE void push_ordered(Item* base, Item*& top, const Item& item, const Nearer& nearer) {
  Item* at = top++;
  for (; at != base && nearer(at[-1], item); --at) *at = at[-1];
  *at = item;
}

}  // namespace sobb
