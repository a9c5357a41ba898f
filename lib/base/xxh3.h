// SPDX-License-Identifier: Apache-2.0
// xxHash's functions, compiled into the files that include this instead of linked.
#pragma once

#ifndef XXH_INLINE_ALL
#define XXH_INLINE_ALL
#endif
#include <xxhash.h>
